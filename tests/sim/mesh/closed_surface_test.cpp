// Closed surfaces, against cubes whose numbers are known.
#include "sim/mesh/closed_surface.h"

#include "sim/mesh/mesh_files.h"

#include <gtest/gtest.h>

namespace rend::closed_surface_test {
namespace {

// A unit cube of quads; one of them turned to the inside.
std::string cube(double at = 0, int first = 1) {
  std::string out;
  for (int z = 0; z < 2; ++z)
    for (int y = 0; y < 2; ++y)
      for (int x = 0; x < 2; ++x) out += fmt::format("v {} {} {}\n", at + x, y, z);
  const int rings[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& ring : rings)
    out += fmt::format("f {} {} {} {}\n", first + ring[0], first + ring[1], first + ring[2], first + ring[3]);
  return out;
}

ClosedSurface surface_of(const std::string& obj) {
  return closed_surface(read_mesh(MeshSource("a.obj", obj)));
}

double area(const ClosedSurface& surface) {
  double sum = 0;
  for (const auto& [a, b, c] : surface.triangles)
    sum += 0.5 * (surface.points[b] - surface.points[a]).cross(surface.points[c] - surface.points[a]).norm();
  return sum;
}

TEST(ClosedSurface, is_oriented_to_the_outside_whatever_its_polygons_are) {
  const ClosedSurface surface = surface_of("v 5 5 5\n" + cube(0, 2)); // a point that nothing uses
  EXPECT_EQ(surface.points.size(), 8u);
  EXPECT_EQ(surface.triangles.size(), 12u);
  EXPECT_NEAR(surface.volume(), 1, 1e-14);
  const Vec3 middle(0.5, 0.5, 0.5);
  for (const auto& [a, b, c] : surface.triangles) {
    const Vec3 x = surface.points[a], normal = (surface.points[b] - x).cross(surface.points[c] - x);
    EXPECT_GT(normal.dot(x - middle), 0.4);
  }
}

TEST(ClosedSurface, keeps_its_shape_when_edges_are_divided) {
  for (double most : {0.9, 0.3, 0.11}) {
    ClosedSurface surface = surface_of(cube());
    divide_edges(surface, most);
    EXPECT_NEAR(surface.volume(), 1, 1e-12) << "closed, and oriented";
    EXPECT_NEAR(area(surface), 6, 1e-12);
    double longest = 0;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    for (const auto& t : surface.triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        longest = std::max(longest, (surface.points[t[k]] - surface.points[t[(k + 1) % 3]]).norm());
        ++sides[{t[k], t[(k + 1) % 3]}];
      }
    EXPECT_LE(longest, most);
    for (const auto& [ends, count] : sides) {
      EXPECT_EQ(count, 1);
      EXPECT_EQ(sides.count({ends.second, ends.first}), 1u);
    }
  }
}

std::string refusal(const std::string& obj) {
  try {
    surface_of(obj);
  } catch (const UserError& error) {
    return error.what();
  }
  return "none";
}

TEST(ClosedSurface, refuses_what_has_no_inside) {
  const auto has = [](const std::string& text, const std::string& part) {
    return text.find(part) != text.npos;
  };
  std::string open = cube();
  open.resize(open.rfind("f "));
  EXPECT_TRUE(has(refusal(open), "belongs to one polygon alone")) << refusal(open);
  EXPECT_TRUE(has(refusal(cube() + cube(3, 9)), "several parts")) << refusal(cube() + cube(3, 9));
  EXPECT_TRUE(has(refusal(cube() + "v 3 3 3\nf 1 2 9\n"), "3 polygons"))
      << refusal(cube() + "v 3 3 3\nf 1 2 9\n");
  // the projective plane, of six points
  std::string plane = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 1 0\nv 1 0 1\n";
  const int faces[10][3] = {{1, 2, 5}, {1, 5, 3}, {1, 3, 6}, {1, 6, 4}, {1, 4, 2},
                            {2, 3, 4}, {2, 3, 6}, {2, 5, 6}, {5, 3, 4}, {5, 6, 4}};
  for (const auto& f : faces) plane += fmt::format("f {} {} {}\n", f[0], f[1], f[2]);
  EXPECT_TRUE(has(refusal(plane), "only one side")) << refusal(plane);
}

TEST(ClosedSurface, is_written_so_that_it_is_read_as_the_same) {
  ClosedSurface surface = surface_of(cube());
  divide_edges(surface, 0.4);
  const ClosedSurface again = closed_surface(read_mesh(MeshSource("a.msh", msh_text(surface))));
  EXPECT_EQ(again.points, surface.points);
  EXPECT_EQ(again.triangles, surface.triangles);
}

// Six tetrahedra around the diagonal of the cube.
CellMesh filled() {
  CellMesh mesh;
  for (int n = 0; n < 8; ++n) mesh.points.push_back(Vec3(n & 1, n >> 1 & 1, n >> 2));
  for (const auto& [a, b] : {std::pair(1, 3), {3, 2}, {2, 6}, {6, 4}, {4, 5}, {5, 1}})
    mesh.add(CellKind::Tetrahedron, {0, static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), 7});
  return mesh;
}

// The boundary of these tetrahedra: the diagonals of its quads from 0 or 7.
std::string triangulated_cube() {
  std::string out = cube();
  out.resize(out.find("f "));
  const int faces[12][3] = {{0, 1, 3}, {0, 3, 2}, {0, 2, 6}, {0, 6, 4}, {0, 4, 5}, {0, 5, 1},
                            {7, 1, 3}, {7, 3, 2}, {7, 2, 6}, {7, 6, 4}, {7, 4, 5}, {7, 5, 1}};
  for (const auto& f : faces) out += fmt::format("f {} {} {}\n", f[0] + 1, f[1] + 1, f[2] + 1);
  return out;
}

TEST(ClosedSurface, knows_what_fills_it) {
  const ClosedSurface surface = surface_of(triangulated_cube());
  EXPECT_EQ(flaw_of_filling(filled(), surface), "");
  CellMesh renumbered = filled();
  std::swap(renumbered.points[1], renumbered.points[6]);
  for (std::uint32_t& c : renumbered.corners) c = c == 1 ? 6 : c == 6 ? 1 : c;
  EXPECT_EQ(flaw_of_filling(renumbered, surface), "");
  const auto has = [](const std::string& text, const std::string& part) {
    return text.find(part) != text.npos;
  };
  CellMesh inverted = filled();
  std::swap(inverted.corners[4], inverted.corners[5]);
  EXPECT_TRUE(has(flaw_of_filling(inverted, surface), "tetrahedron 1 has the volume -"));
  CellMesh moved = filled();
  moved.points[7].z() = 1 + 1e-6;
  EXPECT_TRUE(has(flaw_of_filling(moved, surface), "its boundary differs from the surface in 12 triangles"))
      << flaw_of_filling(moved, surface);
  EXPECT_TRUE(has(flaw_of_filling(filled(), surface_of(cube())), "its boundary differs")) << "other diagonals";
}

} // namespace
} // namespace rend::closed_surface_test
