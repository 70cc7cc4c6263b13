#include "sim/boundary/surface.h"

#include "sim/assets.h"
#include "sim/brute_force.h"
#include "sim/presets.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rend::surface_test {
namespace {

using namespace meshes;

std::vector<BoundaryTriangle> triangles_of(const Surface& surface) {
  std::vector<BoundaryTriangle> all;
  surface.for_each_triangle([&](const BoundaryTriangle& t) { all.push_back(t); });
  return all;
}

std::unique_ptr<Body> tearing(const PolygonMesh& mesh) {
  Recipe recipe;
  recipe.springs = {};
  recipe.criteria = {"global-border"};
  return body(mesh, recipe);
}

// The sides that are drawn as lines, with their kind, by the pair of their end points. Slots are those of
// vertices.
std::multimap<std::pair<Slot, Slot>, LineKind> lines_of(const Surface& surface) {
  std::multimap<std::pair<Slot, Slot>, LineKind> lines;
  for (const BoundaryTriangle& t : triangles_of(surface))
    for (std::size_t k = 0; k < 3; ++k)
      if (t.side[k] != LineKind::Inner)
        lines.insert({std::minmax(t.vertex[(k + 1) % 3], t.vertex[(k + 2) % 3]), t.side[k]});
  return lines;
}

TEST(Surface, cuts_every_polygon_into_triangles_of_its_own_vertices) {
  for (const Named& sheet : irregular(0)) {
    SCOPED_TRACE(sheet.name);
    const auto body = tearing(sheet.mesh);
    const Surface surface(*body->map, body->border);
    std::size_t expected = 0;
    for (std::size_t p = 0; p < sheet.mesh.polygons(); ++p)
      expected += sheet.mesh.first[p + 1] - sheet.mesh.first[p] - 2;
    EXPECT_EQ(surface.triangles(), expected);
    EXPECT_EQ(triangles_of(surface).size(), expected);
    std::map<Slot, std::set<Slot>> vertices; // of each face
    for (std::size_t s = 0; s < sheet.mesh.corners.size(); ++s) {
      const Dart d{2 * s};
      vertices[body->map->slot(FaceOfVolume, d)].insert(body->map->vertex(d));
    }
    for (const BoundaryTriangle& t : triangles_of(surface))
      for (Slot v : t.vertex) EXPECT_TRUE(vertices.at(body->map->slot(FaceOfVolume, t.first)).contains(v));
  }
}

TEST(Surface, of_a_flat_sheet_covers_it_once) {
  const auto body = tearing(bricks(8, 4));
  const Surface surface(*body->map, body->border);
  double area = 0;
  for (const BoundaryTriangle& t : triangles_of(surface)) {
    const auto x = [&](std::size_t k) { return positions(*body)[t.vertex[k]].vec(); };
    area += 0.5 * (x(1) - x(0)).cross(x(2) - x(0)).norm();
  }
  EXPECT_NEAR(area, 32, 1e-12);
}

TEST(Surface, draws_every_side_of_every_polygon_and_no_diagonal) {
  for (const Named& sheet : irregular()) {
    SCOPED_TRACE(sheet.name);
    const auto body = tearing(sheet.mesh);
    const Surface surface(*body->map, body->border);
    std::map<std::pair<Slot, Slot>, int> sides;
    for (std::size_t s = 0; s < sheet.mesh.corners.size(); ++s) {
      const Dart d{2 * s};
      ++sides[std::minmax(body->map->vertex(d), body->map->vertex(Dart{2 * s + 1}))];
    }
    const auto lines = lines_of(surface);
    EXPECT_EQ(lines.size(), sheet.mesh.corners.size());
    for (const auto& [ends, count] : sides) {
      EXPECT_EQ(lines.count(ends), static_cast<std::size_t>(count));
      const auto [begin, end] = lines.equal_range(ends);
      for (auto line = begin; line != end; ++line)
        EXPECT_EQ(line->second, count == 2 ? LineKind::Cell : LineKind::Border);
    }
  }
}

TEST(Surface, shows_a_quad_with_four_sides_and_an_inner_diagonal) {
  const auto body = tearing(sheet(SheetPattern::Quads, 1, 1));
  const Surface surface(*body->map, body->border);
  const auto triangles = triangles_of(surface);
  ASSERT_EQ(triangles.size(), 2u);
  for (const BoundaryTriangle& t : triangles) {
    EXPECT_EQ(std::count(t.side.begin(), t.side.end(), LineKind::Inner), 1);
    EXPECT_EQ(std::count(t.side.begin(), t.side.end(), LineKind::Border), 2);
  }
}

TEST(Surface, marks_both_lips_of_a_tear_and_no_border) {
  for (const Named& sheet : irregular()) {
    SCOPED_TRACE(sheet.name);
    const auto body = tearing(sheet.mesh);
    Surface surface(*body->map, body->border);
    const auto count = [&](LineKind side) {
      std::size_t n = 0;
      for (const auto& line : lines_of(surface)) n += line.second == side;
      return n;
    };
    const std::size_t border = count(LineKind::Border), cells = count(LineKind::Cell);
    EXPECT_EQ(count(LineKind::Torn), 0u);
    Noise noise(3);
    std::size_t torn = 0;
    for (int n = 0; n < 20; ++n) {
      body->map->edit([&](Edit& edit) {
        const Dart d{noise.below(edit.map().capacity())};
        torn += unsew(edit, 2, d);
      });
      surface.update();
      EXPECT_EQ(count(LineKind::Torn), 2 * torn);
      EXPECT_EQ(count(LineKind::Cell), cells - 2 * torn);
      EXPECT_EQ(count(LineKind::Border), border);
    }
    EXPECT_GT(torn, 8u);
    const Surface anew(*body->map, body->border); // what is torn is recorded in the body, not in the surface
    EXPECT_TRUE(anew.same_as(surface));
  }
}

TEST(Surface, marks_what_a_removed_element_leaves_as_torn) {
  const auto body = tearing(sheet(SheetPattern::Quads, 3, 3));
  Surface surface(*body->map, body->border);
  body->map->edit([](Edit& edit) { assets::remove_element(edit, Dart{8u * 4u}); }); // the middle one
  surface.update();
  std::map<LineKind, int> count;
  for (const auto& line : lines_of(surface)) ++count[line.second];
  EXPECT_EQ(surface.triangles(), 16u);
  EXPECT_EQ(count[LineKind::Torn], 4);
  EXPECT_EQ(count[LineKind::Border], 12);
}

TEST(Surface, marks_no_tear_where_nothing_may_tear) {
  Recipe recipe;
  recipe.springs = {};
  const auto body = meshes::body(sheet(SheetPattern::Mixed, 3, 3), recipe);
  EXPECT_EQ(body->border, nullptr);
  const Surface surface(*body->map, body->border);
  for (const auto& line : lines_of(surface)) EXPECT_NE(line.second, LineKind::Torn);
}

TEST(Surface, normals_of_a_flat_sheet_are_across_it) {
  for (auto pattern :
       {SheetPattern::Quads, SheetPattern::Triangles, SheetPattern::Crossed, SheetPattern::Mixed}) {
    const auto body = tearing(sheet(pattern, 4, 3));
    const Surface surface(*body->map, body->border);
    std::vector<Vec3> normals;
    surface.normals(normals);
    ASSERT_EQ(normals.size(), body->program->vertices());
    for (const Vec3& n : normals) {
      EXPECT_NEAR(std::abs(n.z()), 1, 1e-15);
      EXPECT_NEAR(n.head<2>().norm(), 0, 1e-15);
    }
  }
}

TEST(Surface, normals_of_a_cylinder_are_radial) {
  const auto body = tearing(sheet(SheetPattern::Quads, 24, 3, SheetClosure::Loop));
  const Surface surface(*body->map, body->border);
  std::vector<Vec3> normals;
  surface.normals(normals);
  for (Slot v = 0; v < normals.size(); ++v) {
    Vec3 radial = positions(*body)[v].vec();
    radial.y() = 0;
    EXPECT_NEAR(std::abs(normals[v].dot(radial.normalized())), 1, 1e-12);
  }
}

TEST(Surface, normals_are_the_sums_over_corners_up_to_their_sign) {
  for (const Named& sheet : irregular()) {
    SCOPED_TRACE(sheet.name);
    const auto body = tearing(sheet.mesh);
    const Surface surface(*body->map, body->border);
    std::vector<Vec3> normals;
    surface.normals(normals);
    // Around each point the corners' normals, oriented like those of their neighbours by walking across shared
    // edges.
    for (std::uint32_t p = 0; p < sheet.mesh.points.size(); ++p) {
      struct Corner {
        std::uint32_t before, after;
        Vec3 across;
        bool turned = false, reached = false;
      };
      std::vector<Corner> corners;
      Slot vertex = no_slot;
      for (std::size_t f = 0; f < sheet.mesh.polygons(); ++f) {
        const std::uint32_t begin = sheet.mesh.first[f], n = sheet.mesh.first[f + 1] - begin;
        for (std::uint32_t k = 0; k < n; ++k) {
          if (sheet.mesh.corners[begin + k] != p) continue;
          vertex = body->map->vertex(Dart{2 * (begin + k)});
          const std::uint32_t a = sheet.mesh.corners[begin + (k + n - 1) % n],
                              b = sheet.mesh.corners[begin + (k + 1) % n];
          const Vec3 x = sheet.mesh.points[p];
          corners.push_back({a, b, (sheet.mesh.points[b] - x).cross(sheet.mesh.points[a] - x)});
        }
      }
      corners[0].reached = true;
      for (std::size_t round = 0; round < corners.size(); ++round)
        for (const Corner& from : corners) {
          if (!from.reached) continue;
          for (Corner& to : corners) {
            if (to.reached) continue;
            const bool agree = from.after == to.before || from.before == to.after;
            const bool against = from.after == to.after || from.before == to.before;
            if (!agree && !against) continue;
            to.reached = true;
            to.turned = agree ? from.turned : !from.turned;
          }
        }
      Vec3 sum = Vec3::Zero();
      for (const Corner& c : corners) sum += (c.turned ? -1.0 : 1.0) * c.across;
      EXPECT_NEAR(std::abs(sum.normalized().dot(normals[vertex])), 1, 1e-12);
    }
  }
}

TEST(Surface, normals_of_a_moebius_band_are_unit_vectors_everywhere) {
  const auto body = tearing(sheet(SheetPattern::Mixed, 16, 3, SheetClosure::Twist));
  Surface surface(*body->map, body->border);
  for (int n = 0; n < 2; ++n) {
    std::vector<Vec3> normals;
    surface.normals(normals);
    for (Slot v = 0; v < normals.size(); ++v) EXPECT_NEAR(normals[v].norm(), 1, 1e-12);
    body->map->edit([](Edit& edit) { // and torn along its length
      for (std::uint32_t d = 0; d < edit.map().capacity(); d += 3) unsew(edit, 2, Dart{d});
    });
    surface.update();
  }
}

TEST(Surface, of_a_face_that_gains_sides_grows_with_it_and_shrinks_again) {
  const auto body = tearing(sheet(SheetPattern::Quads, 2, 2));
  Surface surface(*body->map, body->border);
  for (int n = 0; n < 4; ++n) {
    apply(rule("insert-vertex"), *body->map, Dart{0u});
    surface.update();
    EXPECT_TRUE(surface.same_as(Surface(*body->map, body->border)));
    EXPECT_EQ(surface.triangles(), 8u + 1u + static_cast<unsigned>(n));
  }
  body->map->edit([](Edit& edit) { assets::remove_element(edit, Dart{0u}); });
  surface.update();
  EXPECT_TRUE(surface.same_as(Surface(*body->map, body->border)));
}

} // namespace
} // namespace rend::surface_test
