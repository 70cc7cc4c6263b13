// The four cells that solids are made of: their corners, faces and darts.
//
// Corners are numbered as in Gmsh: a tetrahedron 0 1 2 | 3, a hexahedron 0 1 2 3 | 4 5 6 7 and a prism 0 1 2 |
// 3 4 5 with the second ring above the first, a pyramid 0 1 2 3 | 4. A cell with this numbering has positive
// volume if the first ring is counter-clockwise as seen from the other corners (Gmsh reference manual, "Node
// ordering").
//
// Faces are listed counter-clockwise as seen from inside, the first ring first. Side s of a cell, from a corner
// to the next of its face, has the darts 2s and 2s+1, at its two ends. Hence the first dart of a cell is at
// corner 0, on the edge to corner 1, in the first ring: the words "", "0", "10", "210" (thesis 5.2.4, fig.
// 5.22) lead to the corners 0 1 2 3 of a tetrahedron.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace rend {

enum class CellKind : std::uint8_t { Tetrahedron, Hexahedron, Prism, Pyramid };

struct CellShape {
  const char* name = "";
  int corners = 0, faces = 0, darts = 0;
  std::array<int, 6> sides{};                      // of each face
  std::array<std::array<int, 4>, 6> ring{};        // its corners
  std::array<int, 6> first{};                      // its first dart
  std::array<std::uint8_t, 48> corner{};           // corner of each dart
  std::array<std::uint8_t, 48> alpha1{}, alpha2{}; // of each dart; α0 is the other one of its side
  std::array<std::array<int, 2>, 2> mirror{};      // pairs of corners whose exchange inverts the cell
};

namespace cell_shapes {

struct Ring {
  int sides;
  std::array<int, 4> corners;
};

// Darts and links, derived from the rings of the faces.
template <std::size_t N>
constexpr CellShape made(const char* name, int corners, const std::array<Ring, N>& rings,
                         std::array<std::array<int, 2>, 2> mirror) {
  CellShape shape;
  shape.name = name;
  shape.corners = corners;
  shape.mirror = mirror;
  for (const Ring& ring : rings) {
    const auto f = static_cast<std::size_t>(shape.faces++);
    shape.sides[f] = ring.sides;
    shape.ring[f] = ring.corners;
    shape.first[f] = shape.darts;
    for (int s = 0; s < ring.sides; ++s) {
      const int begin = shape.darts + 2 * s, end = begin + 1;
      const int next = shape.darts + 2 * ((s + 1) % ring.sides);
      shape.corner[static_cast<std::size_t>(begin)] =
          static_cast<std::uint8_t>(ring.corners[static_cast<std::size_t>(s)]);
      shape.corner[static_cast<std::size_t>(end)] =
          static_cast<std::uint8_t>(ring.corners[static_cast<std::size_t>((s + 1) % ring.sides)]);
      shape.alpha1[static_cast<std::size_t>(end)] = static_cast<std::uint8_t>(next);
      shape.alpha1[static_cast<std::size_t>(next)] = static_cast<std::uint8_t>(end);
    }
    shape.darts += 2 * ring.sides;
  }
  for (std::size_t d = 0; d < static_cast<std::size_t>(shape.darts); ++d)
    for (std::size_t e = 0; e < static_cast<std::size_t>(shape.darts); ++e)
      if (d / 2 != e / 2 && shape.corner[d] == shape.corner[e] && shape.corner[d ^ 1u] == shape.corner[e ^ 1u])
        shape.alpha2[d] = static_cast<std::uint8_t>(e);
  return shape;
}

inline constexpr std::array<CellShape, 4> all{
    made<4>("tetrahedron", 4, {{{3, {0, 1, 2}}, {3, {0, 3, 1}}, {3, {1, 3, 2}}, {3, {0, 2, 3}}}},
            {{{1, 2}, {0, 0}}}),
    made<6>("hexahedron", 8,
            {{{4, {0, 1, 2, 3}},
              {4, {4, 7, 6, 5}},
              {4, {0, 4, 5, 1}},
              {4, {1, 5, 6, 2}},
              {4, {2, 6, 7, 3}},
              {4, {0, 3, 7, 4}}}},
            {{{1, 3}, {5, 7}}}),
    made<5>("prism", 6,
            {{{3, {0, 1, 2}}, {3, {3, 5, 4}}, {4, {0, 3, 4, 1}}, {4, {1, 4, 5, 2}}, {4, {2, 5, 3, 0}}}},
            {{{1, 2}, {4, 5}}}),
    made<5>("pyramid", 5, {{{4, {0, 1, 2, 3}}, {3, {0, 4, 1}}, {3, {1, 4, 2}}, {3, {2, 4, 3}}, {3, {3, 4, 0}}}},
            {{{1, 3}, {0, 0}}})};

} // namespace cell_shapes

constexpr const CellShape& shape_of(CellKind kind) {
  return cell_shapes::all[static_cast<std::size_t>(kind)];
}

} // namespace rend
