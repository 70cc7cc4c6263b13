// The element types of a Gmsh file (Gmsh reference manual, "MSH file format"): their numbers, which ones rend
// reads, and the names of the others.
#pragma once

#include "sim/mesh/cell_shapes.h"

#include <string>

namespace rend {

struct MshType {
  int number;
  const char* name;
  int dimension, nodes;
  CellKind kind; // of dimension 3
};

inline constexpr std::array<MshType, 8> msh_types{{{15, "point", 0, 1, {}},
                                                   {1, "line", 1, 2, {}},
                                                   {2, "triangle", 2, 3, {}},
                                                   {3, "quad", 2, 4, {}},
                                                   {4, "tetrahedron", 3, 4, CellKind::Tetrahedron},
                                                   {5, "hexahedron", 3, 8, CellKind::Hexahedron},
                                                   {6, "prism", 3, 6, CellKind::Prism},
                                                   {7, "pyramid", 3, 5, CellKind::Pyramid}}};

// Null if rend does not read it.
constexpr const MshType* find_msh_type(int number) {
  for (const MshType& type : msh_types)
    if (type.number == number) return &type;
  return nullptr;
}

// Describes a type that is not read: "a line of 3 nodes, of second order".
std::string unread_msh_type(int number);

} // namespace rend
