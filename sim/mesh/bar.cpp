#include "sim/mesh/bar.h"

#include "sim/mesh/locality.h"

#include <algorithm>
#include <array>

namespace rend {
namespace {

using Box = std::array<std::uint32_t, 8>; // corners of a hexahedron, in its order

void add_tetrahedra(CellMesh& mesh, const Box& b) {
  constexpr std::array<std::array<std::size_t, 2>, 6> paths{{{1, 2}, {3, 2}, {1, 5}, {4, 5}, {3, 7}, {4, 7}}};
  for (std::size_t n = 0; n < paths.size(); ++n) {
    const std::uint32_t p = b[paths[n][0]], q = b[paths[n][1]];
    // the permutation's sign; an odd one gives an inverted tetrahedron
    const bool even = n == 0 || n == 3 || n == 4;
    if (even)
      mesh.add(CellKind::Tetrahedron, {b[0], p, q, b[6]});
    else
      mesh.add(CellKind::Tetrahedron, {b[0], q, p, b[6]});
  }
}

void add_prisms(CellMesh& mesh, const Box& b) {
  mesh.add(CellKind::Prism, {b[0], b[1], b[2], b[4], b[5], b[6]});
  mesh.add(CellKind::Prism, {b[0], b[2], b[3], b[4], b[6], b[7]});
}

void add_around_centre(CellMesh& mesh, const Box& b) {
  Vec3 sum = Vec3::Zero();
  for (const std::uint32_t p : b) sum += mesh.points[p];
  const auto centre = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.push_back(sum / 8);
  mesh.add(CellKind::Pyramid, {b[0], b[3], b[7], b[4], centre}); // x low
  mesh.add(CellKind::Pyramid, {b[1], b[5], b[6], b[2], centre}); // x high
  // y low and high, z low and high: each from its lowest corner, counter-clockwise as seen from the centre
  constexpr std::array<std::array<std::size_t, 4>, 4> sides{
      {{0, 4, 5, 1}, {3, 2, 6, 7}, {0, 1, 2, 3}, {4, 7, 6, 5}}};
  for (const auto& s : sides) {
    mesh.add(CellKind::Tetrahedron, {b[s[0]], b[s[1]], b[s[2]], centre});
    mesh.add(CellKind::Tetrahedron, {b[s[0]], b[s[2]], b[s[3]], centre});
  }
}

void add_box(CellMesh& mesh, BarPattern pattern, int slice, const Box& b) {
  if (pattern == BarPattern::Mixed) {
    if (slice % 3 == 2) return add_around_centre(mesh, b);
    pattern = slice % 3 == 1 ? BarPattern::Prisms : BarPattern::Hexahedra;
  }
  if (pattern == BarPattern::Tetrahedra) return add_tetrahedra(mesh, b);
  if (pattern == BarPattern::Prisms) return add_prisms(mesh, b);
  mesh.add(CellKind::Hexahedron, b);
}

// Along x, then y, then z; for many boxes along the shortest side first and the longest last, so that boxes
// around a corner have close numbers: slots and rows follow the order of the boxes (locality.h).
template <class F> void for_each_box(const std::array<int, 3>& boxes, bool many, F&& f) {
  std::array<std::size_t, 3> side{0, 1, 2};
  if (many)
    std::stable_sort(side.begin(), side.end(),
                     [&](std::size_t a, std::size_t b) { return boxes[a] < boxes[b]; });
  std::array<int, 3> at{};
  int &inner = at[side[0]], &middle = at[side[1]], &outer = at[side[2]];
  for (outer = 0; outer < boxes[side[2]]; ++outer)
    for (middle = 0; middle < boxes[side[1]]; ++middle)
      for (inner = 0; inner < boxes[side[0]]; ++inner) f(at[0], at[1], at[2]);
}

} // namespace

template <> const Fields<BarShape>& fields_of() {
  using S = BarShape;
  static const Fields<S> fields{
      field(&S::pattern, word("pattern", {"hexahedra", "tetrahedra", "prisms", "mixed"},
                              "how the bar is divided\nhexahedra: boxes\ntetrahedra: each box cut in six along "
                              "its diagonal\nprisms: each box cut in two, parallel to z\nmixed: slices of "
                              "boxes, of prisms, and of pyramids with tetrahedra, in turn along x")),
      field(std::array{&S::nx, &S::ny, &S::nz},
            integers("cells", 3, "number of boxes along x, y and z").at_least(1).at_most(20000).is_required()),
      field(&S::size, numbers("size", 3, "m", "lengths along x, y and z").above(0).is_required())};
  return fields;
}

CellMesh bar_cells(const BarShape& shape) {
  CellMesh mesh;
  for (int z = 0; z <= shape.nz; ++z)
    for (int y = 0; y <= shape.ny; ++y)
      for (int x = 0; x <= shape.nx; ++x)
        mesh.points.emplace_back(shape.size.x() * x / shape.nx, shape.size.y() * y / shape.ny,
                                 shape.size.z() * z / shape.nz);
  const auto at = [&](int x, int y, int z) {
    return static_cast<std::uint32_t>((z * (shape.ny + 1) + y) * (shape.nx + 1) + x);
  };
  const bool many = mesh.points.size() >= small_mesh_points;
  for_each_box({shape.nx, shape.ny, shape.nz}, many, [&](int x, int y, int z) {
    add_box(mesh, shape.pattern, x,
            {at(x, y, z), at(x + 1, y, z), at(x + 1, y + 1, z), at(x, y + 1, z), at(x, y, z + 1),
             at(x + 1, y, z + 1), at(x + 1, y + 1, z + 1), at(x, y + 1, z + 1)});
  });
  return mesh;
}

} // namespace rend
