// A triangle of the boundary of a body, the same for sheets and solids, and how faces are divided into them.
//
// A face becomes a fan around its first corner: triangle n has the corners 0, n + 1 and n + 2 of the face. Side
// k of a face leads from corner k to the next; only sides are lines, so that a quad shows as a quad.
//
// A triangle holds what is read to draw it: vertices, normals, lines. What else there may be at a corner, on
// any orbit (texture coordinates, a stress, a group), is one lookup away from the dart of the corner. Darts
// are found by a walk when they are asked for (corner_darts): surfaces store none, and who does not ask pays
// nothing.
#pragma once

#include "sim/boundary/line_kind.h"
#include "sim/embedding/slot_table.h"
#include "sim/topology/gmap.h"

#include <array>

namespace rend {

struct BoundaryTriangle {
  std::array<Slot, 3> vertex;          // of a solid: counter-clockwise as seen from outside, at rest
  std::array<std::uint32_t, 3> normal; // index into the normals of its surface
  std::array<LineKind, 3> side;        // opposite to corner k
  Dart first;                          // the smallest dart of its face
  std::uint32_t number;                // in the fan of its face, from 0
  bool turned;                         // the face is walked from α1(first), not from first
  bool exposed;                        // by fracture; always false in a sheet
};

// How many triangles a face becomes.
constexpr std::uint32_t fan_size(std::uint32_t sides) {
  return sides < 3 ? 0 : sides - 2;
}

// The corners of the face that are those of a triangle.
constexpr std::array<std::uint32_t, 3> fan_corners(std::uint32_t number) {
  return {0, number + 1, number + 2};
}

// The lines opposite to its corners, where kind(k) is that of side k of the face.
template <class Kind>
std::array<LineKind, 3> fan_lines(std::uint32_t number, std::uint32_t sides, Kind&& kind) {
  const bool last = number + 1 == fan_size(sides);
  return {kind(number + 1), last ? kind(sides - 1) : LineKind::Inner, number == 0 ? kind(0) : LineKind::Inner};
}

// The darts of its corners; each starts the side of the face that leaves its corner.
std::array<Dart, 3> corner_darts(const GMap& map, const BoundaryTriangle& triangle);

} // namespace rend
