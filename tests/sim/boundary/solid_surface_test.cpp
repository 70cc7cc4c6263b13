// The surface of solids, against their cells as index lists.
#include "sim/boundary/solid_surface.h"

#include "sim/assets.h"
#include "sim/boundary/solid_triangles.h"
#include "sim/boundary/solids.h"

#include <gtest/gtest.h>
#include <map>
#include <set>

namespace rend::solid_surface_test {
namespace {

using namespace solids;

// Faces that belong to a single cell, as sorted points.
std::multiset<std::vector<std::uint32_t>> faces_of_one_cell(const CellMesh& mesh) {
  constexpr std::array<const char*, 4> faces{"012 013 023 123", "0123 4567 0145 1256 2367 3047",
                                             "012 345 0143 1254 2035", "0123 014 124 234 304"};
  std::map<std::vector<std::uint32_t>, int> count;
  for (std::size_t c = 0; c < mesh.cells(); ++c) {
    std::vector<std::uint32_t> face;
    for (const char* at = faces[static_cast<std::size_t>(mesh.kinds[c])];; ++at) {
      if (*at != ' ' && *at != 0) {
        face.push_back(mesh.corners_of(c)[static_cast<std::size_t>(*at - '0')]);
        continue;
      }
      std::sort(face.begin(), face.end());
      ++count[face];
      face.clear();
      if (*at == 0) break;
    }
  }
  std::multiset<std::vector<std::uint32_t>> alone;
  for (const auto& [face, n] : count)
    if (n == 1) alone.insert(face);
  return alone;
}

TEST(SolidSurface, draws_the_faces_that_only_one_cell_has) {
  for (const Named& solid : all()) {
    SCOPED_TRACE(solid.name);
    SewnSolid sewn = sew_cells(solid.mesh);
    const std::vector<std::uint32_t> point = sewn.point;
    const auto body = solids::body(std::move(sewn.map));
    const SolidSurface surface(*body->map, body->border);
    std::map<Dart, std::set<std::uint32_t>> faces;
    for (const BoundaryTriangle& t : triangles_of(surface))
      for (Slot v : t.vertex) faces[t.first].insert(point[v]);
    std::multiset<std::vector<std::uint32_t>> drawn;
    for (const auto& [first, points] : faces) drawn.insert({points.begin(), points.end()});
    EXPECT_EQ(drawn, faces_of_one_cell(solid.mesh));
    EXPECT_EQ(surface.faces(), drawn.size());
  }
}

TEST(SolidSurface, is_closed_and_encloses_the_volume_of_the_cells) {
  for (const Named& solid : all()) {
    SCOPED_TRACE(solid.name);
    const auto body = solids::body(solid.mesh);
    const SolidSurface surface(*body->map, body->border);
    EXPECT_TRUE(open_sides(surface).empty());
    double expected = 0;
    for (std::size_t c = 0; c < solid.mesh.cells(); ++c) expected += signed_volume(solid.mesh, c);
    EXPECT_NEAR(volume_of(*body, surface), expected, 1e-12);
  }
}

TEST(SolidSurface, of_a_ball_has_the_euler_characteristic_of_a_sphere_and_of_a_tube_that_of_a_torus) {
  for (const Named& solid : all()) {
    SCOPED_TRACE(solid.name);
    const auto body = solids::body(solid.mesh);
    std::set<Slot> vertices;
    std::map<std::pair<Slot, Slot>, int> edges;
    const auto triangles = triangles_of(SolidSurface(*body->map, body->border));
    for (const BoundaryTriangle& t : triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        vertices.insert(t.vertex[k]);
        ++edges[std::minmax(t.vertex[k], t.vertex[(k + 1) % 3])];
      }
    for (const auto& [ends, count] : edges) EXPECT_EQ(count, 2);
    const auto euler = static_cast<long>(vertices.size()) - static_cast<long>(edges.size()) +
                       static_cast<long>(triangles.size());
    EXPECT_EQ(euler, solid.name == "tube" ? 0 : 2);
  }
}

TEST(SolidSurface, faces_outward_however_the_darts_are_numbered) {
  for (BarPattern pattern : all_patterns) {
    const auto body = solids::body(bar(pattern, 4, 3, 2));
    SolidSurface surface(*body->map, body->border);
    const auto normals = normals_of(surface);
    for (const BoundaryTriangle& t : triangles_of(surface)) {
      const Vec3 out = (place(*body, t.vertex[0]) + place(*body, t.vertex[1]) + place(*body, t.vertex[2])) / 3 -
                       Vec3(2, 1.5, 1);
      EXPECT_GT(area_vector(*body, t).dot(out), 0);
      for (std::uint32_t c : t.normal) EXPECT_GT(normals[c].dot(out), 0);
    }
  }
  const auto row = solids::body(assets::row_of_cubes(3)); // by hand
  EXPECT_NEAR(volume_of(*row, SolidSurface(*row->map, row->border)), 3, 1e-12);
}

TEST(SolidSurface, of_a_bar_has_sharp_edges_between_flat_sides) {
  for (BarPattern pattern : all_patterns) {
    const auto body = solids::body(bar(pattern, 4, 2, 2));
    SolidSurface surface(*body->map, body->border);
    const auto normals = normals_of(surface);
    for (const BoundaryTriangle& t : triangles_of(surface)) {
      const Vec3 flat = area_vector(*body, t).normalized();
      EXPECT_NEAR(flat.cwiseAbs().maxCoeff(), 1, 1e-12); // along an axis
      for (std::uint32_t c : t.normal) EXPECT_NEAR((normals[c] - flat).norm(), 0, 1e-12);
      for (std::size_t k = 0; k < 3; ++k) {
        if (t.side[k] == LineKind::Inner) continue;
        const Vec3 x = place(*body, t.vertex[(k + 1) % 3]), y = place(*body, t.vertex[(k + 2) % 3]);
        int planes = 0; // sides of the bar that contain the edge
        for (int axis = 0; axis < 3; ++axis)
          planes += x[axis] == y[axis] && (x[axis] == 0 || x[axis] == (axis == 0 ? 4 : 2));
        EXPECT_EQ(t.side[k], planes == 2 ? LineKind::Crease : LineKind::Cell);
      }
    }
  }
}

TEST(SolidSurface, of_a_ball_is_smooth) {
  for (BarPattern pattern : all_patterns) {
    const auto body = solids::body(ball(pattern, 8));
    SolidSurface surface(*body->map, body->border);
    const auto normals = normals_of(surface);
    double worst = 1;
    for (const BoundaryTriangle& t : triangles_of(surface))
      for (std::size_t k = 0; k < 3; ++k) {
        worst = std::min(worst, normals[t.normal[k]].dot(place(*body, t.vertex[k]).normalized()));
        EXPECT_NE(t.side[k], LineKind::Crease);
      }
    EXPECT_GT(worst, std::cos(0.07)) << static_cast<int>(pattern); // 4°
  }
}

TEST(SolidSurface, turns_and_bends_its_normals_with_the_body_but_keeps_its_creases) {
  const auto body = solids::body(bar(BarPattern::Hexahedra, 12, 2, 2));
  SolidSurface surface(*body->map, body->border);
  for (Record& x : body->map->position().values()) { // bent into a quarter of a ring of radius 8
    const double angle = x.vec().x() / 8, r = 7 + x.vec().z();
    x = Record(Vec3(r * std::sin(angle), x.vec().y(), r * std::cos(angle)));
  }
  const auto normals = normals_of(surface);
  for (const BoundaryTriangle& t : triangles_of(surface))
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 rest = body->map->rest()[t.vertex[k]].vec();
      const double angle = rest.x() / 8;
      const Vec3 along(std::cos(angle), 0, -std::sin(angle)), up(std::sin(angle), 0, std::cos(angle));
      const Vec3 n = normals[t.normal[k]];
      const double best = std::max(
          {std::abs(n.dot(along)), std::abs(n.dot(up)), std::abs(n.y())}); // along one of the rotated axes
      EXPECT_GT(best, std::cos(0.07));
    }
}

TEST(SolidSurface, of_a_collapsed_solid_has_no_normals_and_no_nan) {
  const auto body = solids::body(bar(BarPattern::Mixed, 3, 1, 1));
  for (Record& x : body->map->position().values()) x = Record(1, 2, 3);
  SolidSurface surface(*body->map, body->border);
  for (const Vec3& n : normals_of(surface)) EXPECT_EQ(n, Vec3::Zero());
}

TEST(SolidSurface, marks_what_is_laid_bare_around_a_cell_cut_free_and_keeps_it_flat) {
  const auto body = solids::body(bar(BarPattern::Hexahedra, 3, 3, 3));
  SolidSurface surface(*body->map, body->border);
  const Dart middle{13u * 48};
  body->map->edit([&](Edit& edit) {
    for (Dart d : darts_of(edit.map(), Volume, middle)) unsew(edit, 3, d);
  });
  surface.update();
  EXPECT_TRUE(surface.same_as(SolidSurface(*body->map, body->border)));
  EXPECT_EQ(surface.faces(), 54u + 12);
  EXPECT_TRUE(open_sides(surface).empty());
  EXPECT_NEAR(volume_of(*body, surface), 27, 1e-12);
  const auto normals = normals_of(surface);
  std::set<Dart> exposed;
  for (const BoundaryTriangle& t : triangles_of(surface)) {
    if (t.exposed) exposed.insert(t.first);
    for (std::uint32_t c : t.normal)
      EXPECT_NEAR((normals[c] - area_vector(*body, t).normalized()).norm(), 0, 1e-12);
  }
  EXPECT_EQ(exposed.size(), 12u);
  body->map->edit([&](Edit& edit) { assets::remove_element(edit, middle); });
  surface.update();
  EXPECT_EQ(surface.faces(), 54u + 6);
  EXPECT_NEAR(volume_of(*body, surface), 26, 1e-12);
}

TEST(SolidSurface, keeps_the_hull_smooth_and_the_bare_faces_flat_on_a_warped_solid) {
  CellMesh mesh = ball(BarPattern::Hexahedra, 6);
  const auto body = solids::body(mesh);
  SolidSurface surface(*body->map, body->border);
  body->map->edit([&](Edit& edit) { // unsews the cross-section in the middle
    for (std::uint32_t d = 0; d < edit.map().capacity(); ++d) {
      double most = 0;
      for (Dart e : darts_of(edit.map(), FaceOfVolume, Dart{d}))
        most = std::max(most, std::abs(body->map->rest_of(e).x()));
      if (most < 1e-12) unsew(edit, 3, Dart{d});
    }
  });
  surface.update();
  const auto normals = normals_of(surface);
  std::size_t exposed = 0;
  for (const BoundaryTriangle& t : triangles_of(surface))
    for (std::size_t k = 0; k < 3; ++k) {
      exposed += t.exposed;
      const Vec3 expected =
          t.exposed ? area_vector(*body, t).normalized() : place(*body, t.vertex[k]).normalized();
      // At a cut, a corner averages over its own side only, which is tilted like a chord.
      EXPECT_GT(normals[t.normal[k]].dot(expected), t.exposed ? 1 - 1e-12 : std::cos(0.25));
    }
  EXPECT_EQ(exposed, 2u * 36 * 2 * 3);
}

TEST(SolidSurface, marks_nothing_bare_where_nothing_may_tear) {
  const auto body = solids::body(bar(BarPattern::Mixed, 3, 2, 2), false);
  SolidSurface surface(*body->map, body->border);
  body->map->edit([&](Edit& edit) {
    for (std::uint32_t d = 0; d < edit.map().capacity(); d += 7) unsew(edit, 3, Dart{d});
  });
  surface.update();
  EXPECT_TRUE(surface.same_as(SolidSurface(*body->map, body->border)));
  for (const BoundaryTriangle& t : triangles_of(surface)) EXPECT_FALSE(t.exposed);
  EXPECT_FALSE(body->map->uses(FaceOfVolume)); // no slots for faces are allocated either
}

} // namespace
} // namespace rend::solid_surface_test
