#include "sim/mesh/msh_writer.h"

#include "sim/mesh/dart_order.h"
#include "sim/mesh/msh_types.h"
#include "sim/topology/walk.h"

#include <fmt/format.h>

namespace rend {
namespace {

struct Element {
  int type; // Gmsh's number
  std::vector<Dart> corners;
};

Element element_of(const EmbeddedMap& body, Dart d, const std::string& name) {
  const GMap& map = body.map();
  if (map.dimension() == 2) {
    Element face{0, {}};
    Dart at = d;
    do {
      face.corners.push_back(at);
      at = map.alpha(1, map.alpha(0, at));
    } while (at != d);
    if (face.corners.size() > 4)
      throw UserError(
          Exit::BadInput, {name},
          fmt::format("a face has {} sides, and Gmsh has triangles and quads", face.corners.size()));
    face.type = face.corners.size() == 3 ? 2 : 3;
    return face;
  }
  for (const MshType& type : msh_types) {
    if (type.dimension != 3) continue;
    const CellShape& shape = shape_of(type.kind);
    const std::vector<Dart> darts = darts_in_shape_order(map, shape, d);
    if (darts.empty()) continue;
    Element cell{type.number, std::vector<Dart>(static_cast<std::size_t>(shape.corners))};
    for (std::size_t n = 0; n < darts.size(); ++n) cell.corners[shape.corner[n]] = darts[n];
    return cell;
  }
  throw UserError(Exit::BadInput, {name}, "a volume is none of tetrahedron, hexahedron, prism, pyramid",
                  "write it as .moka, which holds any");
}

} // namespace

std::string msh_text(const MeshBody& body, const std::string& name) {
  const EmbeddedMap& map = *body.map;
  const CellIndex& vertices = map.cells(Vertex);
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  if (!body.groups.empty()) {
    text += fmt::format("$PhysicalNames\n{}\n", body.groups.size());
    int number = 0;
    for (const auto& [group, slots] : body.groups) text += fmt::format("0 {} \"{}\"\n", ++number, group);
    text += "$EndPhysicalNames\n";
  }
  text += fmt::format("$Nodes\n{}\n", vertices.count());
  for (Slot v = 0; v < vertices.slots(); ++v) {
    const Record& x = map.rest()[v];
    if (vertices.alive(v)) text += fmt::format("{} {} {} {}\n", v + 1, x.x, x.y, x.z);
  }
  text += "$EndNodes\n";
  std::string elements;
  std::size_t count = 0;
  int group = 0;
  for (const auto& [group_name, slots] : body.groups) {
    ++group;
    for (const Slot v : slots) elements += fmt::format("{} 15 2 {} 0 {}\n", ++count, group, v + 1);
  }
  const CellIndex cells(map.map(), element_orbit(map.dimension()));
  for (Slot c = 0; c < cells.slots(); ++c) {
    const Element element = element_of(map, cells.first_dart(c), name);
    elements += fmt::format("{} {} 2 0 0", ++count, element.type);
    for (const Dart d : element.corners) elements += fmt::format(" {}", map.vertex(d) + 1);
    elements += '\n';
  }
  return text + fmt::format("$Elements\n{}\n", count) + elements + "$EndElements\n";
}

} // namespace rend
