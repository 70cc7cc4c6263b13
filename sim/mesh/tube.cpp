#include "sim/mesh/tube.h"

#include "sim/base/check.h"

namespace rend {
namespace {

// The points of a rectangle in the xy plane from (w, w) to (lx - w, ly - w), `quarter` steps a side,
// counter-clockwise.
std::vector<Vec3> contour(const TubeShape& shape, double w, int quarter) {
  const double x0 = w, y0 = w, x1 = shape.size.x() - w, y1 = shape.size.y() - w;
  const std::array<Vec3, 4> corners{Vec3(x0, y0, 0), Vec3(x1, y0, 0), Vec3(x1, y1, 0), Vec3(x0, y1, 0)};
  std::vector<Vec3> points;
  for (std::size_t side = 0; side < 4; ++side)
    for (int n = 0; n < quarter; ++n) {
      const double t = static_cast<double>(n) / quarter;
      points.push_back((1 - t) * corners[side] + t * corners[(side + 1) % 4]);
    }
  return points;
}

} // namespace

template <> const Fields<TubeShape>& fields_of() {
  using S = TubeShape;
  static const Fields<S> fields{
      field(std::array{&S::around, &S::along},
            integers("cells", 2, "number of cells around (a multiple of 4) and along z")
                .at_least(1)
                .at_most(20000)
                .is_required()),
      field(&S::size, numbers("size", 3, "m", "outer lengths along x, y and z").above(0).is_required()),
      field(&S::wall,
            number("wall", "m", "thickness of the wall: less than half of the outer lengths along x and y")
                .above(0)
                .is_required())};
  return fields;
}

CellMesh tube_cells(const TubeShape& shape) {
  CHECK(shape.around >= 4 && shape.around % 4 == 0 && shape.along >= 1);
  CHECK(shape.wall > 0 && 2 * shape.wall < std::min(shape.size.x(), shape.size.y()));
  CellMesh mesh;
  const int n = shape.around;
  const std::vector<Vec3> outer = contour(shape, 0, n / 4), inner = contour(shape, shape.wall, n / 4);
  for (int z = 0; z <= shape.along; ++z)
    for (const auto* ring : {&outer, &inner})
      for (const Vec3& p : *ring) mesh.points.emplace_back(p.x(), p.y(), shape.size.z() * z / shape.along);
  const auto at = [&](int k, bool inside, int z) {
    return static_cast<std::uint32_t>((2 * z + (inside ? 1 : 0)) * n + k % n);
  };
  for (int z = 0; z < shape.along; ++z)
    for (int k = 0; k < n; ++k)
      mesh.add(CellKind::Hexahedron,
               {at(k, false, z), at(k + 1, false, z), at(k + 1, true, z), at(k, true, z), at(k, false, z + 1),
                at(k + 1, false, z + 1), at(k + 1, true, z + 1), at(k, true, z + 1)});
  return mesh;
}

} // namespace rend
