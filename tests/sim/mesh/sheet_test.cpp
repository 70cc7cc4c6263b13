#include "sim/mesh/sheet.h"

#include "sim/base/math.h"
#include "sim/topology/count.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace rend::sheet_test {
namespace {

using enum SheetPattern;
using enum SheetClosure;

struct Case {
  SheetPattern pattern;
  SheetClosure closure;
  int nx, ny;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (SheetPattern pattern : {Quads, Triangles, Crossed, Mixed})
    for (SheetClosure closure : {None, Loop, Twist})
      for (auto [nx, ny] : {std::pair{3, 1}, {4, 3}, {7, 2}, {5, 5}}) all.push_back({pattern, closure, nx, ny});
  for (SheetPattern pattern : {Quads, Triangles, Crossed, Mixed})
    for (auto [nx, ny] : {std::pair{1, 1}, {2, 1}, {1, 4}}) all.push_back({pattern, None, nx, ny});
  return all;
}

SheetShape shape_of(const Case& c) {
  SheetShape shape;
  shape.pattern = c.pattern;
  shape.closure = c.closure;
  shape.nx = c.nx;
  shape.ny = c.ny;
  shape.size = {3, 0.5};
  return shape;
}

std::string name_of(const Case& c) {
  return "pattern " + std::to_string(static_cast<int>(c.pattern)) + ", closure " +
         std::to_string(static_cast<int>(c.closure)) + ", " + std::to_string(c.nx) + " x " +
         std::to_string(c.ny);
}

// The number of closed border lines of a sheet.
int border_lines(const GMap& map) {
  std::vector<char> seen(map.capacity(), 0);
  int lines = 0;
  map.for_each_dart([&](Dart start) {
    if (seen[start.value] || !map.is_free(2, start)) return;
    ++lines;
    for (Dart d = start; !seen[d.value];) {
      seen[d.value] = 1;
      Dart e = map.alpha(0, d);
      seen[e.value] = 1;
      for (e = map.alpha(1, e); !map.is_free(2, e);) e = map.alpha(1, map.alpha(2, e));
      d = e;
    }
  });
  return lines;
}

// Whether darts have a 2-colouring in which every link changes the colour.
bool orientable(const GMap& map) {
  std::vector<int> colour(map.capacity(), 0);
  std::vector<Dart> rest;
  bool fits = true;
  map.for_each_dart([&](Dart start) {
    if (colour[start.value] != 0) return;
    colour[start.value] = 1;
    rest.push_back(start);
    while (!rest.empty()) {
      const Dart d = rest.back();
      rest.pop_back();
      for (int i = 0; i < 3; ++i) {
        const Dart e = map.alpha(i, d);
        if (e == d) continue;
        if (colour[e.value] == 0) {
          colour[e.value] = -colour[d.value];
          rest.push_back(e);
        }
        fits = fits && colour[e.value] == -colour[d.value];
      }
    }
  });
  return fits;
}

TEST(SheetGenerator, has_the_cells_of_its_pattern) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(name_of(c));
    const auto map = sheet_from(sheet_polygons(shape_of(c)));
    ASSERT_EQ(validate(*map), std::nullopt);
    const std::size_t nx = static_cast<std::size_t>(c.nx), ny = static_cast<std::size_t>(c.ny), cells = nx * ny;
    const std::size_t across = c.closure == None ? nx + 1 : nx; // rows of points
    const std::size_t crossed = c.pattern == Crossed ? cells : c.pattern == Mixed ? cells / 2 : 0;
    const std::size_t cut = c.pattern == Triangles ? cells : 0;
    const CellCounts counts = count_cells(map->map());
    EXPECT_EQ(counts.vertices, across * (ny + 1) + crossed);
    EXPECT_EQ(counts.edges, nx * (ny + 1) + across * ny + cut + 4 * crossed);
    EXPECT_EQ(counts.faces, cells + cut + 3 * crossed);
    EXPECT_EQ(counts.fragments, 1u);
    EXPECT_EQ(counts.euler, c.closure == None ? 1 : 0);
  }
}

TEST(SheetGenerator, a_disc_and_a_moebius_band_have_one_border_line_and_a_loop_has_two) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(name_of(c));
    const auto map = sheet_from(sheet_polygons(shape_of(c)));
    EXPECT_EQ(border_lines(map->map()), c.closure == Loop ? 2 : 1);
    EXPECT_EQ(orientable(map->map()), c.closure != Twist);
  }
}

TEST(SheetGenerator, covers_the_rectangle) {
  for (SheetPattern pattern : {Quads, Triangles, Crossed, Mixed}) {
    const PolygonMesh mesh = sheet_polygons(shape_of({pattern, None, 6, 4}));
    Vec3 area = Vec3::Zero(); // of all polygons, by their own orientation
    for (std::size_t p = 0; p < mesh.polygons(); ++p)
      for (std::uint32_t c = mesh.first[p]; c < mesh.first[p + 1]; ++c) {
        const std::uint32_t next = c + 1 < mesh.first[p + 1] ? c + 1 : mesh.first[p];
        area += 0.5 * mesh.points[mesh.corners[c]].cross(mesh.points[mesh.corners[next]]);
      }
    EXPECT_NEAR((area - Vec3(0, 0, 1.5)).norm(), 0, 1e-14);
    for (const Vec3& x : mesh.points) {
      EXPECT_TRUE(x.x() >= 0 && x.x() <= 3 && x.y() >= 0 && x.y() <= 0.5 && x.z() == 0);
    }
  }
}

TEST(SheetGenerator, puts_points_bilinearly_between_given_corners) {
  SheetShape shape = shape_of({Quads, None, 4, 3});
  shape.corners = {Vec3(0, 0, 0), Vec3(2, 0, 1), Vec3(3, 2, -1), Vec3(-1, 1, 0.5)};
  const PolygonMesh mesh = sheet_polygons(shape);
  for (int y = 0; y <= 3; ++y)
    for (int x = 0; x <= 4; ++x) {
      const double s = x / 4.0, t = y / 3.0;
      const Vec3 low = (*shape.corners)[0] + s * ((*shape.corners)[1] - (*shape.corners)[0]);
      const Vec3 high = (*shape.corners)[3] + s * ((*shape.corners)[2] - (*shape.corners)[3]);
      EXPECT_NEAR((mesh.points[static_cast<std::size_t>(5 * y + x)] - (low + t * (high - low))).norm(), 0,
                  1e-15);
    }
}

TEST(SheetGenerator, lays_a_loop_on_a_cylinder_of_its_circumference) {
  const PolygonMesh mesh = sheet_polygons(shape_of({Quads, Loop, 8, 2}));
  for (const Vec3& x : mesh.points) EXPECT_NEAR(std::hypot(x.x(), x.z()), 3 / (2 * pi), 1e-15);
  double low = 1, high = -1;
  for (const Vec3& x : mesh.points) {
    low = std::min(low, x.y());
    high = std::max(high, x.y());
  }
  EXPECT_EQ(low, -0.25);
  EXPECT_EQ(high, 0.25);
}

// In a band, no side along it is longer than on the strip's outer circle, and sides across it have the length
// that the width gives: the seam closes without a jump.
TEST(SheetGenerator, closes_a_band_without_a_jump) {
  for (SheetClosure closure : {Loop, Twist}) {
    const int nx = 60, ny = 4;
    const PolygonMesh mesh = sheet_polygons(shape_of({Quads, closure, nx, ny}));
    for (std::size_t p = 0; p < mesh.polygons(); ++p) {
      const auto point = [&](std::uint32_t n) { return mesh.points[mesh.corners[mesh.first[p] + n]]; };
      EXPECT_NEAR((point(2) - point(1)).norm(), 0.5 / ny, 1e-14) << "polygon " << p;
      EXPECT_NEAR((point(0) - point(3)).norm(), 0.5 / ny, 1e-14) << "polygon " << p;
      for (const double around : {(point(1) - point(0)).norm(), (point(3) - point(2)).norm()}) {
        EXPECT_LT(around, (3 + 2 * pi * 0.25 + pi * 0.25) / nx);
        EXPECT_GT(around, (3 - 2 * pi * 0.25) / nx * 0.99);
      }
    }
  }
}

TEST(SheetGenerator, turns_a_moebius_band_by_half_a_turn_on_the_way_around) {
  const int nx = 90;
  const PolygonMesh mesh = sheet_polygons(shape_of({Quads, Twist, nx, 1}));
  double turned = 0; // [degrees], rotation of the transverse direction about the centre line
  for (int x = 0; x < nx; ++x) {
    const auto across = [&](int column) {
      const Vec3 low = mesh.points[static_cast<std::size_t>(column % nx)];
      const Vec3 high = mesh.points[static_cast<std::size_t>(column % nx + nx)];
      return Vec3((column < nx ? 1 : -1) * (high - low).normalized());
    };
    const Vec3 a = across(x), b = across(x + 1);
    turned += std::acos(std::clamp(a.dot(b), -1.0, 1.0)) * 180 / pi;
  }
  EXPECT_GT(turned, 180); // it also follows the circle
  EXPECT_LT(turned, 180 + 360);
  EXPECT_NEAR((mesh.points[0] - mesh.points[nx]).norm(), 0.5, 1e-15);
}

} // namespace
} // namespace rend::sheet_test
