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

} // namespace rend
