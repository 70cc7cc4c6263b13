#include "sim/mesh/sheet.h"

#include "sim/base/check.h"
#include "sim/base/math.h"

namespace rend {

template <> const Fields<SheetShape>& fields_of() {
  using S = SheetShape;
  static const Fields<S> fields{
      field(&S::pattern, word("pattern", {"quads", "triangles", "crossed", "mixed"},
                              "how the sheet is divided\nquads: quads\ntriangles: each quad cut in two along a "
                              "diagonal\ncrossed: each quad cut in four around its centre\nmixed: every second "
                              "quad cut in four, the others whole")),
      field(std::array{&S::nx, &S::ny},
            integers("cells", 2, "number of quads along x and y").at_least(1).at_most(20000).is_required()),
      field(&S::size,
            numbers("size", 2, "m", "lengths along x and y (of a band: around it and across it)").above(0)),
      field(
          &S::corners,
          numbers("corners", 12, "m",
                  "instead of size: the four corners, in order around the sheet; points between are bilinear")),
      field(&S::closure, word("close", {"none", "loop", "twist"},
                              "joins the ends x = 0 and x = lx\nnone: a flat sheet\nloop: a closed "
                              "band\ntwist: a Moebius band"))};
  return fields;
}

namespace {

// The point at (s, t) in [0,1]²: s along x, t along y.
Vec3 point_of_band(const SheetShape& shape, double s, double t) {
  const auto [lx, ly] = *shape.size;
  const double radius = lx / (2 * pi), degrees = 360 * s;
  const Vec3 outwards(sine_of_degrees(degrees), 0, -cosine_of_degrees(degrees));
  const double across = (t - 0.5) * ly; // from the middle of the band
  if (shape.closure == SheetClosure::Loop) return radius * outwards + Vec3(0, across, 0);
  const double half = 180 * s; // a half turn about the middle line over the length of the strip
  return radius * outwards +
         across * (cosine_of_degrees(half) * Vec3(0, 1, 0) + sine_of_degrees(half) * outwards);
}

std::array<Vec3, 4> corners_of(const SheetShape& shape) {
  if (shape.corners) return *shape.corners;
  const auto [lx, ly] = *shape.size;
  return {Vec3(0, 0, 0), Vec3(lx, 0, 0), Vec3(lx, ly, 0), Vec3(0, ly, 0)};
}

Vec3 point_at(const SheetShape& shape, double s, double t) {
  if (shape.closure != SheetClosure::None) return point_of_band(shape, s, t);
  const std::array<Vec3, 4> c = corners_of(shape);
  return (1 - s) * (1 - t) * c[0] + s * (1 - t) * c[1] + s * t * c[2] + (1 - s) * t * c[3];
}

class Grid {
public:
  Grid(const SheetShape& shape, PolygonMesh& mesh) : shape_(shape) {
    columns_ = shape.closure == SheetClosure::None ? shape.nx + 1 : shape.nx;
    for (int y = 0; y <= shape.ny; ++y)
      for (int x = 0; x < columns_; ++x)
        mesh.points.push_back(point_at(shape, double(x) / shape.nx, double(y) / shape.ny));
  }

  // The index of the grid point (x, y); at the seam of a band, x = nx is identified with x = 0.
  std::uint32_t operator()(int x, int y) const {
    if (x == columns_) { // nx on a band
      x = 0;
      if (shape_.closure == SheetClosure::Twist) y = shape_.ny - y;
    }
    return static_cast<std::uint32_t>(y * columns_ + x);
  }

private:
  const SheetShape& shape_;
  int columns_;
};

} // namespace

PolygonMesh sheet_polygons(const SheetShape& shape) {
  CHECK(shape.size || shape.corners);
  PolygonMesh mesh;
  const Grid grid(shape, mesh);
  for (int y = 0; y < shape.ny; ++y) {
    for (int x = 0; x < shape.nx; ++x) {
      const std::uint32_t a = grid(x, y), b = grid(x + 1, y), c = grid(x + 1, y + 1), d = grid(x, y + 1);
      const bool crossed =
          shape.pattern == SheetPattern::Crossed || (shape.pattern == SheetPattern::Mixed && (x + y) % 2 == 1);
      if (crossed) {
        const auto centre = static_cast<std::uint32_t>(mesh.points.size());
        mesh.points.push_back(0.25 * (mesh.points[a] + mesh.points[b] + mesh.points[c] + mesh.points[d]));
        for (auto [p, q] : {std::pair{a, b}, {b, c}, {c, d}, {d, a}}) mesh.add({p, q, centre});
      } else if (shape.pattern == SheetPattern::Triangles) {
        mesh.add({a, b, c});
        mesh.add({a, c, d});
      } else {
        mesh.add({a, b, c, d});
      }
    }
  }
  return mesh;
}

} // namespace rend
