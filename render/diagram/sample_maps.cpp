#include "render/diagram/sample_maps.h"

#include "sim/base/check.h"
#include "sim/base/error.h"
#include "sim/base/wording.h"
#include "sim/house_rules/house_scripts.h"
#include "sim/rules/script_run.h"
#include "sim/rules/sheet_in_space.h"
#include "sim/topology/walk.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {
namespace {

using Map = std::unique_ptr<EmbeddedMap>;

Map empty(int dimension) {
  return std::make_unique<EmbeddedMap>(dimension);
}

void run(EmbeddedMap& map, std::string_view name, const Hooks& hooks = {}, const RuleArguments& with = {}) {
  const Applied done = apply(rule(name), map, hooks, with);
  CHECK_NOTE(done.ok, done.reason);
}

RuleArguments corners(const std::vector<Vec3>& points) {
  RuleArguments out;
  char name = 'p';
  for (const Vec3& at : points) out.emplace_back(std::string(1, name++), vector_value(at.x(), at.y(), at.z()));
  return out;
}

void add_quad(EmbeddedMap& map, double x, double y) {
  run(map, "create-quad", {}, corners({{x, y, 0}, {x + 1, y, 0}, {x + 1, y + 1, 0}, {x, y + 1, 0}}));
}
void add_triangle(EmbeddedMap& map, const std::vector<Vec3>& points) {
  run(map, "create-triangle", {}, corners(points));
}

// Sews the edges of faces, or the faces of volumes, that lie on each other.
void sew_what_meets(EmbeddedMap& body) {
  const GMap& map = body.map();
  const int link = map.dimension();
  const Orbit shared = link == 2 ? Orbit{0} : Orbit{0, 1};
  const auto meet = [&](Dart a, Dart b) {
    const std::vector<Dart> left = darts_of(map, shared, a), right = darts_of(map, shared, b);
    return left.size() == right.size() &&
           std::equal(left.begin(), left.end(), right.begin(),
                      [&](Dart d, Dart e) { return body.position_of(d) == body.position_of(e); });
  };
  for (Dart a{0u}; a.value < map.capacity(); a = Dart{a.value + 1})
    for (Dart b{0u}; b.value < a.value; b = Dart{b.value + 1})
      if (map.is_free(link, a) && map.is_free(link, b) && !same_cell(map, shared, a, b) && meet(a, b))
        run(body, link == 2 ? "sew-edges" : "sew-faces", {a, b});
}

Map quads(int columns, int rows) {
  Map map = empty(2);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) add_quad(*map, x, y);
  sew_what_meets(*map);
  return map;
}

Map pulled_apart() {
  Map map = empty(2);
  add_quad(*map, 0, 0);
  add_quad(*map, 1.3, 0);
  return map;
}

Map triangles() {
  Map map = empty(2);
  add_triangle(*map, {{0, 0, 0}, {1, 0, 0}, {0.5, 0.9, 0}});
  add_triangle(*map, {{1, 0, 0}, {1.5, 0.9, 0}, {0.5, 0.9, 0}});
  sew_what_meets(*map);
  return map;
}

Map triangle_sheet() {
  Map map = quads(3, 3);
  for (std::uint32_t n = 0; n < 9; ++n) run(*map, "halve-quad", Dart{8 * n});
  return map;
}

// Of unit cubes in a row, from x on.
void add_cube(EmbeddedMap& map, double x) {
  add_quad(map, x, 0);
  run(map, "extrude-face", Dart{map.map().capacity() - 8});
}

Map cubes(int count, double step) {
  Map map = empty(3);
  for (int n = 0; n < count; ++n) add_cube(*map, n * step);
  sew_what_meets(*map);
  return map;
}

Map tetrahedra(int count, double gap) {
  const Vec3 low(0, 0, 0), right(1, 0, 0), back(0, 1, 0), top(0, 0, 1), far(1, 1, 0.8);
  Map map = empty(3);
  run(*map, "create-tetrahedron", {}, corners({low, right, back, top}));
  const Vec3 by = gap * Vec3(1, 1, 1);
  if (count > 1) run(*map, "create-tetrahedron", {}, corners({right + by, far + by, back + by, top + by}));
  sew_what_meets(*map);
  return map;
}

// The first steps of the script that divides it into eight.
Map cut_tetrahedron(std::size_t steps) {
  ScriptSettings settings = divide_tetrahedra();
  settings.steps.resize(steps);
  const Script cut(settings,
                   [](const ScriptStepSettings& step) { return *find_house_rule_or_script(step.apply); });
  Map map = tetrahedra(1, 0);
  ScriptRunner runner(cut);
  map->edit([&](Edit& edit) { CHECK_NOTE(runner.apply(edit, Dart{0u}), runner.reason()); });
  return map;
}

Map vertex() {
  Map map = empty(3);
  run(*map, "create-vertex");
  return map;
}

Map faces() {
  return sheet_in_space(*quads(2, 2));
}

Map edge() {
  Map map = vertex();
  run(*map, "extrude-vertex", Dart{0u});
  return map;
}

Map face() {
  Map map = empty(3);
  add_quad(*map, 0, 0);
  return map;
}

int face_faults(const GMap& map) {
  int faults = 0;
  map.for_each_dart([&](Dart d) {
    const int sides = sides_of_face(map, d);
    faults += sides == 1 || sides == 2;
  });
  return faults;
}

class Search {
public:
  Search(const Rule& rule, const SampleMap& sample) : rule_(rule), sample_(sample), map_(sample.make()) {
    if (map_->dimension() == 2 && rule.plan.links_volumes) return;
    choose({});
    std::stable_sort(found_.begin(), found_.end(),
                     [](const Found& a, const Found& b) { return a.apart < b.apart; });
  }

  RuleShown run() {
    RuleShown best;
    int least = -1;
    for (std::size_t n = 0; n < std::min<std::size_t>(found_.size(), most_trials) && least != 0; ++n) {
      Map after = sample_.make();
      if (!apply(rule_, *after, hooks_of(found_[n].darts)).ok) continue;
      const int faults = face_faults(after->map());
      if (least >= 0 && faults >= least) continue;
      least = faults;
      best = {&sample_, nullptr, std::move(after), found_[n].darts};
    }
    if (best.sample) best.before = std::move(map_);
    return best;
  }

private:
  static constexpr std::size_t most_trials = 100, most_tuples = 100'000;
  struct Found {
    std::vector<Dart> darts;
    double apart = 0; // of the hooks' darts and what they lead to by α0 [m]
  };

  static Hooks hooks_of(const std::vector<Dart>& darts) {
    if (darts.empty()) return {};
    if (darts.size() == 1) return {darts[0]};
    if (darts.size() == 2) return {darts[0], darts[1]};
    if (darts.size() == 3) return {darts[0], darts[1], darts[2]};
    return {darts[0], darts[1], darts[2], darts[3]};
  }

  // All choices of a dart for each hook where the left graph is there.
  void choose(std::vector<Dart> darts) {
    if (darts.size() == rule_.plan.hooks.size()) {
      if (++tuples_ > most_tuples || find_match(rule_, map_->map(), hooks_of(darts), match_)) return;
      found_.push_back({darts, apart(darts)});
      return;
    }
    if (rule_.plan.hooks.size() > 4) return; // more than Hooks holds
    for (Dart d{0u}; d.value < map_->map().capacity() && tuples_ <= most_tuples; d = Dart{d.value + 1}) {
      darts.push_back(d);
      choose(darts);
      darts.pop_back();
    }
  }

  double apart(const std::vector<Dart>& darts) const {
    double sum = 0;
    const auto far = [&](Dart d) { return map_->position_of(map_->map().alpha(0, d)); };
    for (std::size_t n = 1; n < darts.size(); ++n)
      sum += (map_->position_of(darts[n]) - map_->position_of(darts[0])).norm() +
             (far(darts[n]) - far(darts[0])).norm();
    return sum;
  }

  const Rule& rule_;
  const SampleMap& sample_;
  Map map_;
  Match match_;
  std::size_t tuples_ = 0;
  std::vector<Found> found_;
};

bool speaks_of_volumes(const Rule& rule) {
  if (rule.plan.links_volumes) return true;
  for (const RuleGraph* graph : {&rule.left, &rule.right})
    for (const RuleNode& node : graph->nodes)
      if (node.links[3].kind == RuleLink::Kind::Arc) return true;
  return false;
}

// It links two hooks to each other.
bool sews(const Rule& rule) {
  for (int n = 0; n < rule.right.size(); ++n)
    for (const RuleLink& link : rule.right[n].links) {
      if (link.kind != RuleLink::Kind::Arc) continue;
      const auto is_hook = [&](int node) {
        const int before = rule.before[static_cast<std::size_t>(node)];
        return before >= 0 && rule.left[before].hook;
      };
      if (is_hook(n) && is_hook(link.to)) return true;
    }
  return false;
}

} // namespace

const std::vector<SampleMap>& sample_maps() {
  static const std::vector<SampleMap> all{
      {"nothing", "an empty map", [] { return empty(3); }},
      {"sheet", "2 x 2 quads", [] { return quads(2, 2); }},
      {"triangles", "two triangles", triangles},
      {"quad", "a quad", [] { return quads(1, 1); }},
      {"two-quads", "two quads, not sewn", pulled_apart, true},
      {"large-sheet", "3 x 3 quads", [] { return quads(3, 3); }},
      {"triangle-sheet", "18 triangles", triangle_sheet},
      {"cubes", "two cubes", [] { return cubes(2, 1); }},
      {"cube", "a cube", [] { return cubes(1, 1); }},
      {"tetrahedra", "two tetrahedra", [] { return tetrahedra(2, 0); }},
      {"tetrahedron", "a tetrahedron", [] { return tetrahedra(1, 0); }},
      {"two-cubes", "two cubes, not sewn", [] { return cubes(2, 1.4); }, true},
      {"two-tetrahedra", "two tetrahedra, not sewn", [] { return tetrahedra(2, 0.25); }, true},
      {"cut-tetrahedron", "a tetrahedron with a triangle cut off each corner of its faces",
       [] { return cut_tetrahedron(2); }},
      {"octahedron", "an octahedron with a tetrahedron on every second face",
       [] { return cut_tetrahedron(3); }},
      {"face", "a face of a solid that has no volume yet", face},
      {"faces", "four faces of a solid that has no volume yet", faces},
      {"edge", "an edge", edge},
      {"vertex", "a vertex", vertex}};
  return all;
}

std::vector<const SampleMap*> samples_called(const std::string& name) {
  std::vector<const SampleMap*> found;
  std::vector<std::string> names;
  for (const SampleMap& each : sample_maps()) {
    names.push_back(each.name);
    if (name.empty() || each.name == name) found.push_back(&each);
  }
  if (found.empty())
    throw UserError(Exit::Usage, {}, fmt::format("there is no map {} to draw a rule on", in_quotes(name)),
                    suggestion(name, names, "there are"));
  return found;
}

RuleShown show(const Rule& rule, const std::string& sample) {
  if (!rule.quantities_of_law().empty()) return {}; // known only where a law applies it
  std::vector<const SampleMap*> order =
      samples_called(sample.empty() && rule.only_creates() ? "nothing" : sample);
  const int dimension = speaks_of_volumes(rule) ? 3 : 2;
  const bool apart = sews(rule);
  const auto misfits = [&](const SampleMap* each) {
    return (each->make()->dimension() != dimension ? 2 : 0) + (each->apart != apart ? 1 : 0);
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](const SampleMap* a, const SampleMap* b) { return misfits(a) < misfits(b); });
  for (const SampleMap* each : order)
    if (RuleShown shown = Search(rule, *each).run(); shown.sample) return shown;
  return {};
}

} // namespace rend
