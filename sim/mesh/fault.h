// Why a mesh cannot be sewn, and which of its elements is at fault.
//
// Generators never throw it. Readers catch it and add the element's place in the file.
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

// The fault of a cell whose volume [m³] or area [m²] is lost in round-off relative to the cube or square of its
// length [m]: "has no volume", or "has proportions too extreme to reckon with: 6.4e+09 m3 at a length of 1e+10
// m".
std::string flaw_of_volume(double volume, double length);
std::string flaw_of_area(double area, double length);

} // namespace rend
