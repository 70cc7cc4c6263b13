// What lies along a side of a drawn face or triangle.
#pragma once

#include <cstdint>

namespace rend {

enum class Side : std::uint8_t {
  Inner = 0,  // a diagonal: nothing
  Cell = 1,   // an edge between two cells
  Border = 2, // of a sheet: a border from the start
  Torn = 3,   // of a sheet: laid bare by tearing
  Crease = 4, // of a solid: the surface bends sharply there, or changes from hull to what fracture laid bare
};

} // namespace rend
