// The cells on which criteria are evaluated and changes are made.
#pragma once

#include "sim/embedding/embedded_map.h"

#include <span>
#include <string>
#include <vector>

namespace rend {

enum class Cell {
  Edges,
  Borders,  // between two elements: an edge of a sheet, a face of a solid
  Vertices, // with the plane along which the vertex would be split
  Elements, // a face of a sheet, a volume of a solid
};

Orbit orbit_of(Cell cell, int dimension);
std::string name_of(Cell cell, int dimension); // "edge", "face" ...

// The slots of the element corners of the darts, without repetition, in increasing order: those before an edit,
// which does not change them.
std::vector<Slot> corners_of(const EmbeddedMap& map, std::span<const Dart> darts);

// The mean of the positions [m, one per vertex slot] of the vertices of these darts.
Vec3 middle_of(const EmbeddedMap& map, const Record* position, std::span<const Dart> darts);

} // namespace rend
