#include "sim/fracture/cell.h"

#include "sim/base/enum_words.h"
#include "sim/mechanics/mass.h"

#include <algorithm>

namespace rend {

Orbit orbit_of(Cell cell, int dimension) {
  switch (cell) {
  case Cell::Edges:
    return Edge;
  case Cell::Borders:
    return dimension == 2 ? Edge : Face;
  case Cell::Vertices:
    return Vertex;
  case Cell::Elements:
    return element_orbit(dimension);
  }
  return {};
}

std::string name_of(Cell cell, int dimension) {
  static constexpr EnumWords<Cell::Elements> of_sheet{"edge", "edge", "vertex", "face"};
  static constexpr EnumWords<Cell::Elements> of_solid{"edge", "face", "vertex", "volume"};
  return dimension == 2 ? of_sheet[cell] : of_solid[cell];
}

std::vector<Slot> corners_of(const EmbeddedMap& map, std::span<const Dart> darts) {
  const Orbit corner = corner_orbit(map.dimension());
  std::vector<Slot> slots;
  for (Dart d : darts) slots.push_back(map.slot(corner, d));
  std::sort(slots.begin(), slots.end());
  slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
  return slots;
}

Vec3 middle_of(const EmbeddedMap& map, const Record* x, std::span<const Dart> darts) {
  thread_local std::vector<Slot> vertices;
  vertices.clear();
  for (Dart d : darts) vertices.push_back(map.vertex(d));
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  Vec3 sum = Vec3::Zero();
  for (Slot v : vertices) sum += x[v].vec();
  return sum / static_cast<double>(vertices.size());
}

} // namespace rend
