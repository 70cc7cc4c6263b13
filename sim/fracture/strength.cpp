#include "sim/fracture/strength.h"

#include "sim/base/check.h"
#include "sim/base/hash.h"
#include "sim/base/math.h"
#include "sim/mechanics/mass.h"
#include "sim/topology/index_set.h"
#include "sim/topology/walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

namespace rend {
namespace {

constexpr double least_strength = 1e-6;

enum class Known : std::size_t { Rest, Random, Weibull, In };

const std::vector<ExpressionFunction>& words() {
  constexpr auto S = ValueType::Scalar;
  static const std::vector<ExpressionFunction> all{
      {"rest", {}, ValueType::Vector, "the middle of the element at rest [m]"},
      {"random", {}, S, "one draw for each element, between 0 and 1"},
      {"weibull", {S, S}, S, "a draw of Weibull's distribution; of its modulus, and of a volume or area", 1},
      {"in", {ValueType::Name}, ValueType::Condition, "whether the element is in a group of the mesh file"}};
  return all;
}

Expression read(const StrengthSettings& settings, const SettingsSource& source) {
  try {
    return {settings.factor, words(), ValueType::Scalar};
  } catch (const ExpressionError& error) {
    source.fail("strength", error.what(), error.hint);
  }
}

// Of each vertex of an element one dart.
const std::vector<Dart>& corners_at(const EmbeddedMap& map, Dart element) {
  thread_local IndexSet seen;
  thread_local std::vector<Dart> darts;
  seen.clear();
  darts.clear();
  collect(map.map(), element_orbit(map.dimension()), element, darts);
  const CellIndex& vertices = map.cells(Vertex);
  std::erase_if(darts, [&](Dart d) { return !seen.insert(vertices.slot(d)); });
  return darts;
}

double size_at_rest(const EmbeddedMap& map, Dart element) { // [m³], [m²]
  return map.dimension() == 3 ? rest_volume(map, element) : rest_area(map, element);
}

} // namespace

template <> const Fields<StrengthSettings>& fields_of() {
  using S = StrengthSettings;
  static const Fields<S> fields =
      fields_of_part(&S::where) +
      Fields<S>{
          field(&S::factor, text("strength", "what the threshold is multiplied by, from element to element: an "
                                             "expression of rest (the middle of the element [m]), "
                                             "random, weibull(m), in(group), noise(...)")),
          field(&S::seed, integer("seed", "of random and weibull: another one gives other draws").at_least(0))};
  return fields;
}

struct StrengthExpression::Element {
  Vec3 middle;               // [m], at rest
  double size;               // [m³], of a sheet [m²], at rest
  std::vector<Slot> corners; // increasing
};

StrengthExpression::StrengthExpression(const StrengthSettings& settings, EmbeddedMap& map,
                                       const VertexGroups& groups, const SettingsSource& source)
    : expression_(read(settings, source)), seed_(settings.seed), source_(source) {
  for (const ExpressionCall& call : expression_.calls())
    for (const std::string& name : call.names)
      groups_[name] = vertices_of_group(groups, name, "strength", source);
  const CellIndex& elements = map.use(element_orbit(map.dimension()));
  for (Slot e = 0; e < elements.slots(); ++e)
    if (elements.alive(e)) size_ += size_at_rest(map, elements.first_dart(e));
}

double StrengthExpression::at(const EmbeddedMap& map, Dart element) const {
  Element there{Vec3::Zero(), size_at_rest(map, element), {}};
  for (Dart d : corners_at(map, element)) {
    there.middle += map.rest_of(d);
    there.corners.push_back(map.cells(Vertex).slot(d));
  }
  there.middle /= static_cast<double>(there.corners.size());
  std::sort(there.corners.begin(), there.corners.end());
  const auto where = [&] {
    return fmt::format("at ({:.6g}, {:.6g}, {:.6g})", there.middle.x(), there.middle.y(), there.middle.z());
  };
  try {
    const double factor =
        expression_
            .evaluate([&](const ExpressionCall& call, std::size_t, std::span<const Value> arguments) {
              return supply(call, arguments, there);
            })
            .scalar();
    if (factor > least_strength) return factor;
    source_.fail(
        "strength",
        fmt::format("the strength is {:g} {}, and must be above {:g}", factor, where(), least_strength),
        "max(0.1, ...) keeps it above 0.1");
  } catch (const ExpressionError& error) {
    source_.fail("strength", fmt::format("{} ({})", error.what(), where()), error.hint);
  }
}

double StrengthExpression::random_at(const Vec3& middle) const {
  const std::array<double, 3> place{middle.x() + 0.0, middle.y() + 0.0, middle.z() + 0.0}; // no -0
  const std::uint64_t hash = hash_bytes(place.data(), sizeof place, static_cast<std::uint64_t>(seed_));
  return (static_cast<double>(hash >> 12) + 0.5) * 0x1p-52;
}

Value StrengthExpression::supply(const ExpressionCall& call, std::span<const Value> arguments,
                                 const Element& there) const {
  switch (static_cast<Known>(call.function)) {
  case Known::Rest:
    return vector_value(there.middle.x(), there.middle.y(), there.middle.z());
  case Known::Random:
    return scalar_value(random_at(there.middle));
  case Known::Weibull: {
    const double modulus = arguments[0].scalar(), whole = arguments.size() > 1 ? arguments[1].scalar() : size_;
    if (!(modulus > 0) || !(whole > 0))
      throw ExpressionError(call.column, "'weibull' is of a modulus above 0, and of a volume or area above 0",
                            "weibull(8) is one of modulus 8");
    return scalar_value(power(whole / there.size * -logarithm(1 - random_at(there.middle)), 1 / modulus));
  }
  case Known::In:
    break;
  }
  const std::vector<Slot>& group = groups_.at(call.names.front());
  return condition_value(std::includes(group.begin(), group.end(), there.corners.begin(), there.corners.end()));
}

bool StrengthExpression::draws() const {
  return std::ranges::any_of(expression_.calls(), [](const ExpressionCall& call) {
    const auto known = static_cast<Known>(call.function);
    return known == Known::Random || known == Known::Weibull;
  });
}

std::shared_ptr<Strength> Strength::of(const StrengthSettings& settings, Cell cell, std::optional<double> walls,
                                       EmbeddedMap& map, const VertexGroups& groups,
                                       const SettingsSource& source) {
  std::shared_ptr<Strength> made(new Strength(cell));
  bool draws = false;
  if (!settings.factor.empty() || source.given("strength")) {
    const auto expression = std::make_shared<StrengthExpression>(settings, map, groups, source);
    draws = expression->draws();
    ElementStrength strength{.orbit = element_orbit(map.dimension()), .expression = expression};
    made->strength_ = &map.add(std::move(strength));
    made->elements_ = &map.cells(made->strength_->orbit());
    expression->forget_groups();
  }
  if (walls) {
    made->pieces_ = find_pieces(map);
    CHECK(made->pieces_);
    made->wall_ = *walls;
  }
  made->rebind();
  if (source.given("seed") && !draws)
    source.fail("seed", "<tear> has a seed, and no strength that draws anything",
                "strength=\"1 + 0.3*random\" is one that does");
  if (settings.where.given() || source.given("group"))
    made->select(map, select_vertices(map, groups, settings.where, "tear", source), source);
  return made->strength_ || made->selected_ || made->pieces_ ? made : nullptr;
}

void Strength::rebind() {
  least_ = wall_;
  if (!strength_) return;
  least_ = std::numeric_limits<double>::max();
  for (Slot e = 0; e < elements_->slots(); ++e)
    if (elements_->alive(e)) least_ = std::min(least_, (*strength_)[e]);
  least_ *= wall_;
}

void Strength::select(EmbeddedMap& map, const std::vector<Slot>& vertices, const SettingsSource& source) {
  auto& selected = map.add(SelectedVertex{});
  for (Slot v : vertices) selected[v] = 1;
  selected_ = &selected;
  bool any = false;
  map.map().for_each_dart(
      [&](Dart d) { any = any || is_selected(map, darts_of(map.map(), orbit_of(cell_, map.dimension()), d)); });
  if (any) return;
  source.fail("", fmt::format("<tear> selects no {} with all its vertices", name_of(cell_, map.dimension())),
              "the criterion measures these: select more vertices");
}

bool Strength::is_selected(const EmbeddedMap& map, std::span<const Dart> cell) const {
  if (!selected_) return true;
  return std::ranges::all_of(cell, [&](Dart d) { return (*selected_)[map.slot(Vertex, d)] != 0; });
}

double Strength::at(const EmbeddedMap& map, std::span<const Dart> cell) const {
  if (!strength_) return 1;
  double least = std::numeric_limits<double>::infinity();
  for (Dart d : cell) least = std::min(least, (*strength_)[map.slot(strength_->orbit(), d)]);
  return least;
}

void Strength::weigh(const EmbeddedMap& map, double above, std::vector<Candidate>& candidates) const {
  thread_local std::vector<Dart> cell;
  const Orbit orbit = orbit_of(cell_, map.dimension());
  std::erase_if(candidates, [&](Candidate& candidate) {
    cell.clear();
    collect(map.map(), orbit, candidate.dart, cell);
    if (!is_selected(map, cell)) return true;
    candidate.strength = at(map, cell);
    candidate.wall = pieces_ && is_at_wall(map, *pieces_, cell);
    if (candidate.wall) candidate.strength *= wall_;
    return !(candidate.relative() > above);
  });
}

} // namespace rend
