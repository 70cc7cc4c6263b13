#include "sim/build/selector.h"

#include "sim/base/wording.h"

#include <fmt/format.h>

namespace rend {

void add_selector(std::vector<AttributeType>& attributes) {
  attributes.push_back(numbers("near", 3, "m", "select the vertex closest to this point"));
  attributes.push_back(numbers("box", 6, "m", "select the vertices in the box x0 y0 z0 x1 y1 z1"));
  attributes.push_back(
      word("side", {"-x", "+x", "-y", "+y", "-z", "+z"}, "select the vertices at that end of the body"));
  attributes.push_back(text("group", "select the vertices of a group that the mesh file names"));
  attributes.push_back(flag("all", "select every vertex"));
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

const std::vector<Slot>& vertices_of_group(const Body& body, const PresetNode& node) {
  const std::string& name = node.text("group");
  const auto group = body.groups.find(name);
  if (group != body.groups.end()) return group->second;
  std::vector<std::string> names;
  for (const auto& [each, slots] : body.groups) names.push_back(each);
  node.fail("group", fmt::format("the body has no group {}", in_quotes(name)),
            names.empty() ? "groups come from a <mesh> whose file has them"
                          : suggestion(name, names, "groups"));
}

} // namespace

std::vector<Slot> select_vertices(const Body& body, const PresetNode& node) {
  const EmbeddedMap& map = *body.map;
  std::vector<std::string> given;
  for (const char* name : {"near", "box", "side", "group", "all"})
    if (node.given(name)) given.push_back(name);
  if (given.size() != 1)
    throw UserError(Exit::BadInput, node.place(),
                    given.empty() ? fmt::format("<{}> selects nothing", node.name())
                                  : fmt::format("<{}> has {} selectors", node.name(), given.size()),
                    "give one of near, box, side, group, all");
  const std::string& how = given.front();
  const Bounds b = bounds_of(map);
  const double slack = 1e-9 * (b.high - b.low).maxCoeff();
  std::vector<Slot> chosen;
  if (how == "near") {
    chosen = nearest_vertex(map, node.vector("near"));
  } else if (how == "box") {
    const std::vector<double>& v = node.numbers("box");
    const Vec3 low = Vec3(v[0], v[1], v[2]).cwiseMin(Vec3(v[3], v[4], v[5]));
    const Vec3 high = Vec3(v[0], v[1], v[2]).cwiseMax(Vec3(v[3], v[4], v[5]));
    chosen = vertices_where(map, [&](const Vec3& x) {
      return (x.array() >= low.array() - slack).all() && (x.array() <= high.array() + slack).all();
    });
  } else if (how == "side") {
    const std::string& side = node.text("side");
    const int axis = side[1] - 'x';
    chosen = vertices_where(map, [&](const Vec3& x) {
      return side[0] == '-' ? x[axis] <= b.low[axis] + slack : x[axis] >= b.high[axis] - slack;
    });
  } else if (how == "group") {
    chosen = vertices_of_group(body, node);
  } else if (node.flag("all")) {
    chosen = vertices_where(map, [](const Vec3&) { return true; });
  }
  if (chosen.empty())
    node.fail(how, "selects no vertex",
              fmt::format("at rest the body reaches from ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g})",
                          b.low.x(), b.low.y(), b.low.z(), b.high.x(), b.high.y(), b.high.z()));
  return chosen;
}

} // namespace rend
