#include "sim/mesh/msh_types.h"

#include <fmt/format.h>

namespace rend {

std::string unread_msh_type(int number) {
  struct Known {
    int number;
    const char* what;
  };
  constexpr std::array<Known, 11> second{{{8, "line of 3 nodes"},
                                          {9, "triangle of 6 nodes"},
                                          {10, "quad of 9 nodes"},
                                          {11, "tetrahedron of 10 nodes"},
                                          {12, "hexahedron of 27 nodes"},
                                          {13, "prism of 18 nodes"},
                                          {14, "pyramid of 14 nodes"},
                                          {16, "quad of 8 nodes"},
                                          {17, "hexahedron of 20 nodes"},
                                          {18, "prism of 15 nodes"},
                                          {19, "pyramid of 13 nodes"}}};
  for (const Known& known : second)
    if (known.number == number) return fmt::format("is a {}, of second order", known.what);
  return number >= 20 && number <= 140 ? fmt::format("is of type {}, of third order or beyond", number)
                                       : fmt::format("is of type {}, which Gmsh does not know", number);
}

} // namespace rend
