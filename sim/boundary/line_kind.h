// What kind of line a side of a boundary face or triangle is.
#pragma once

#include <cstdint>

namespace rend {

enum class LineKind : std::uint8_t {
  Inner = 0,  // a diagonal of a face: no line
  Cell = 1,   // an edge between two cells
  Border = 2, // of a sheet: on the initial boundary
  Torn = 3,   // of a sheet: exposed by tearing
  Crease = 4, // of a solid: a sharp edge, or one between the initial boundary and faces exposed by fracture
};

} // namespace rend
