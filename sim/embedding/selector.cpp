#include "sim/embedding/selector.h"

#include "sim/base/wording.h"

#include <fmt/format.h>

namespace rend {

template <> const Fields<Selector>& fields_of() {
  using S = Selector;
  static const Fields<S> fields{
      field(&S::near, numbers("near", 3, "m", "select the vertex closest to this point")),
      field(&S::box, numbers("box", 6, "m", "select the vertices in the box x0 y0 z0 x1 y1 z1")),
      field(&S::side,
            word("side", {"-x", "+x", "-y", "+y", "-z", "+z"}, "select the vertices at that end of the body")),
      field(&S::group, text("group", "select the vertices of a group that the mesh file names")),
      field(&S::all, flag("all", "select every vertex"))};
  return fields;
}

bool Selector::given() const {
  return near || box || !side.empty() || !group.empty() || all;
}

namespace {

struct Bounds {
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);
};

Bounds bounds_of(const EmbeddedMap& map) {
  Bounds b;
  const CellIndex& cells = map.cells(Vertex);
  for (Slot v = 0; v < cells.slots(); ++v) {
    if (!cells.alive(v)) continue;
    b.low = b.low.cwiseMin(map.rest()[v].vec());
    b.high = b.high.cwiseMax(map.rest()[v].vec());
  }
  return b;
}

template <class F> std::vector<Slot> vertices_where(const EmbeddedMap& map, F&& inside) {
  std::vector<Slot> chosen;
  const CellIndex& cells = map.cells(Vertex);
  for (Slot v = 0; v < cells.slots(); ++v)
    if (cells.alive(v) && inside(map.rest()[v].vec())) chosen.push_back(v);
  return chosen;
}

std::vector<Slot> nearest_vertex(const EmbeddedMap& map, const Vec3& to) {
  const CellIndex& cells = map.cells(Vertex);
  Slot best = no_slot;
  double least = 1e300;
  for (Slot v = 0; v < cells.slots(); ++v) {
    if (!cells.alive(v)) continue;
    const double distance = (map.rest()[v].vec() - to).squaredNorm();
    if (distance < least) {
      least = distance;
      best = v;
    }
  }
  return {best};
}

} // namespace

const std::vector<Slot>& vertices_of_group(const VertexGroups& groups, const std::string& name,
                                           std::string_view attribute, const SettingsSource& source) {
  const auto group = groups.find(name);
  if (group != groups.end()) return group->second;
  std::vector<std::string> names;
  for (const auto& [each, slots] : groups) names.push_back(each);
  source.fail(attribute, fmt::format("the body has no group {}", in_quotes(name)),
              names.empty() ? "groups come from a <mesh> whose file has them"
                            : suggestion(name, names, "groups"));
}

namespace {

std::vector<Slot> vertices_in_box(const EmbeddedMap& map, const std::array<double, 6>& v, double slack) {
  const Vec3 low = Vec3(v[0], v[1], v[2]).cwiseMin(Vec3(v[3], v[4], v[5]));
  const Vec3 high = Vec3(v[0], v[1], v[2]).cwiseMax(Vec3(v[3], v[4], v[5]));
  return vertices_where(map, [&](const Vec3& x) {
    return (x.array() >= low.array() - slack).all() && (x.array() <= high.array() + slack).all();
  });
}

std::vector<Slot> vertices_at_end(const EmbeddedMap& map, const std::string& side, const Bounds& b,
                                  double slack) {
  const int axis = side[1] - 'x';
  return vertices_where(map, [&](const Vec3& x) {
    return side[0] == '-' ? x[axis] <= b.low[axis] + slack : x[axis] >= b.high[axis] - slack;
  });
}

// Which of its selectors are given: one, or UserError.
std::string selector_of(const Selector& selector, const std::string& element, const SettingsSource& source) {
  std::vector<std::string> given;
  const auto note = [&](bool is, const char* name) {
    if (is || source.given(name)) given.emplace_back(name);
  };
  note(selector.near.has_value(), "near");
  note(selector.box.has_value(), "box");
  note(!selector.side.empty(), "side");
  note(!selector.group.empty(), "group");
  note(selector.all.has_value(), "all");
  if (given.size() == 1) return given.front();
  source.fail("",
              given.empty() ? fmt::format("<{}> selects nothing", element)
                            : fmt::format("<{}> has {} selectors", element, given.size()),
              "give one of near, box, side, group, all");
}

} // namespace

std::vector<Slot> select_vertices(const EmbeddedMap& map, const VertexGroups& groups, const Selector& selector,
                                  const std::string& element, const SettingsSource& source) {
  const std::string how = selector_of(selector, element, source);
  const Bounds b = bounds_of(map);
  const double slack = 1e-9 * (b.high - b.low).maxCoeff();
  std::vector<Slot> chosen;
  if (how == "near")
    chosen = nearest_vertex(map, *selector.near);
  else if (how == "box")
    chosen = vertices_in_box(map, *selector.box, slack);
  else if (how == "side")
    chosen = vertices_at_end(map, selector.side, b, slack);
  else if (how == "group")
    chosen = vertices_of_group(groups, selector.group, "group", source);
  else if (*selector.all)
    chosen = vertices_where(map, [](const Vec3&) { return true; });
  if (chosen.empty())
    source.fail(
        how, fmt::format("<{}> selects no vertex", element),
        fmt::format("at rest the body reaches from ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g})",
                    b.low.x(), b.low.y(), b.low.z(), b.high.x(), b.high.y(), b.high.z()));
  return chosen;
}

} // namespace rend
