// What makes a mesh impossible to sew, and which of its elements is to blame.
//
// Generators never throw it. A reader catches it and adds where in the file that element stands.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace rend {

// "polygon 7: meets point 3 twice". Elements are numbered from 0, in the order in which the mesh holds them.
struct MeshFault : std::invalid_argument {
  MeshFault(const std::string& kind, std::size_t number, const std::string& flaw);
  std::size_t element; // its number in the mesh
  std::string flaw;    // "meets point 3 twice"
};

// What is wrong with a cell of this volume [m³] or area [m²], which is lost in round-off beside the cube or
// square of its length [m]: "has no volume", or "has proportions too extreme to reckon with: 6.4e+09 m3 at a
// length of 1e+10 m".
std::string flaw_of_volume(double volume, double length);
std::string flaw_of_area(double area, double length);

} // namespace rend
