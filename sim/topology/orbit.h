// Orbits: sets of darts reached by some of the involutions α0..α3 (thesis 3.3.2, fig. 3.15; sim/README.md, "The
// map").
//
// An orbit <i,j,..>(d) is the set of darts reached from d by αi, αj, ... Cells are orbits: a vertex is all that
// is reached without α0. In a sheet (every dart α3-free) <0,1> is an element and <0,1,2> a connected component;
// in a solid <0,1,2> is an element.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>

namespace rend {

struct Orbit {
  std::uint8_t mask = 0; // bit i: αi may be followed

  constexpr Orbit() = default;
  constexpr Orbit(std::initializer_list<int> links) {
    for (int i : links) mask = static_cast<std::uint8_t>(mask | (1 << i));
  }
  constexpr bool has(int i) const { return (mask >> i & 1) != 0; }
  friend constexpr bool operator==(Orbit, Orbit) = default;
};

inline constexpr Orbit Vertex{1, 2, 3};
inline constexpr Orbit Edge{0, 2, 3};
inline constexpr Orbit Face{0, 1, 3};
inline constexpr Orbit Volume{0, 1, 2};
inline constexpr Orbit Component{0, 1, 2, 3};
inline constexpr Orbit VertexOfVolume{1, 2};
inline constexpr Orbit EdgeOfVolume{0, 2};
inline constexpr Orbit FaceOfVolume{0, 1};
inline constexpr Orbit VertexOfFace{1};
inline constexpr Orbit EdgeOfFace{0};
inline constexpr Orbit EdgeEndOfVolume{2};
inline constexpr Orbit EdgeEnd{2, 3};
inline constexpr Orbit VertexOfFaceBothSides{1, 3};
inline constexpr Orbit DartBothSides{3};
inline constexpr Orbit EdgeOfFaceBothSides{0, 3};
inline constexpr Orbit SingleDart{};

constexpr int orbit_kinds = 16; // masks 0..15

std::string to_string(Orbit orbit); // "<0,2,3>"
const char* name(Orbit orbit);      // "Edge"

constexpr Orbit element_orbit(int dimension) {
  return dimension == 2 ? FaceOfVolume : Volume;
}

} // namespace rend
