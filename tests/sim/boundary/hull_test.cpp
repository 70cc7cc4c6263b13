#include "sim/boundary/hull.h"

#include "sim/assets.h"
#include "sim/boundary/boundary_faces.h"
#include "sim/boundary/solids.h"
#include "sim/mechanics/interaction.h"
#include "sim/topology/walk.h"

#include <gtest/gtest.h>
#include <map>

namespace rend::hull_test {
namespace {

// A prism over an L, one volume with two hexagons and six quads: not convex.
std::unique_ptr<EmbeddedMap> prism_over_an_l() {
  using assets::at;
  const std::vector<std::pair<double, double>> ring{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
  auto body = std::make_unique<EmbeddedMap>(3);
  body->edit([&](Edit& edit) {
    for (double z : {0.0, 1.0}) {
      std::vector<Point> points;
      for (const auto& [x, y] : ring) points.push_back(at(x, y, z));
      assets::create_polygon(edit, points);
    }
    for (std::size_t n = 0; n < ring.size(); ++n) {
      const auto [x, y] = ring[n];
      const auto [u, v] = ring[(n + 1) % ring.size()];
      assets::create_polygon(edit, std::vector<Point>{at(x, y), at(u, v), at(u, v, 1), at(x, y, 1)});
    }
  });
  assets::sew_coincident(*body);
  return body;
}

TEST(Hull, knows_its_outside_where_a_volume_is_not_convex) {
  const auto body = prism_over_an_l();
  ASSERT_EQ(count_cells(body->map(), Volume), 1u);
  body->map().for_each_dart([&](Dart d) {
    ASSERT_FALSE(body->map().is_free(2, d));
    const Vec3 area = rest_area_vector(*body, d);
    Vec3 centre = Vec3::Zero(); // a point of the face, offset along its normal: inside or outside of the L?
    const auto darts = darts_of(body->map(), FaceOfVolume, d);
    for (Dart e : darts) centre += body->rest_of(e) / static_cast<double>(darts.size());
    if (darts.size() == 12) centre.head<2>().setConstant(0.5); // the mean of an L's corners is not inside it
    const Vec3 probe = centre + 0.1 * area.normalized();
    const bool inside = probe.z() > 0 && probe.z() < 1 && probe.x() > 0 && probe.y() > 0 &&
                        ((probe.x() < 3 && probe.y() < 1) || (probe.x() < 1 && probe.y() < 3));
    EXPECT_EQ(winds_outward(*body, d), !inside);
  });
}

TEST(Hull, finds_the_area_of_a_face_however_it_is_cut) {
  const auto body = prism_over_an_l();
  body->map().for_each_dart([&](Dart d) {
    const double area = 0.5 * rest_area_vector(*body, d).norm();
    EXPECT_NEAR(area, sides_of_face(body->map(), d) == 6 ? 5 : std::round(area), 1e-12);
  });
}

TEST(Hull, crosses_an_edge_to_the_other_face_and_back) {
  for (const solids::Named& solid : solids::all()) {
    SCOPED_TRACE(solid.name);
    const auto body = solid_from(solid.mesh);
    const GMap& map = body->map();
    map.for_each_dart([&](Dart d) {
      if (!map.is_free(3, d)) return;
      const Dart e = across_hull_edge(map, d);
      EXPECT_TRUE(map.is_free(3, e));
      EXPECT_NE(e, d);
      EXPECT_EQ(across_hull_edge(map, e), d);
      EXPECT_TRUE(same_cell(map, EdgeEnd, d, e));
    });
  }
}

TEST(Hull, ends_at_the_rim_of_an_open_volume) {
  const auto body = solids::body(assets::row_of_cubes(2));
  const GMap& map = body->map->map();
  body->map->edit([](Edit& edit) { unsew(edit, 2, Dart{0u}); });
  map.for_each_dart(
      [&](Dart d) { EXPECT_TRUE(!map.is_free(3, d) || across_hull_edge(map, across_hull_edge(map, d)) == d); });
}

TEST(BoundaryFaces, are_the_same_in_whatever_order_they_came) {
  const auto face = [](std::uint32_t key, std::uint32_t sides) {
    return BoundaryFaces::Face{Dart{key}, false, false, sides};
  };
  const auto corners = [](std::uint32_t key, std::uint32_t sides) {
    return std::vector<BoundaryFaces::Corner>(sides, {key, Dart{key}, LineKind::Cell});
  };
  std::map<std::uint32_t, std::uint32_t> expected; // key → sides
  BoundaryFaces drawn;
  drawn.resize(1000);
  std::mt19937 random(4);
  for (int n = 0; n < 3000; ++n) {
    const auto key = static_cast<std::uint32_t>(random() % 1000), sides = 3 + key % 4;
    if (random() % 2 == 0) {
      EXPECT_EQ(drawn.erase(Dart{key}), expected.erase(key) == 1);
      continue;
    }
    drawn.set(face(key, sides), corners(key, sides));
    expected[key] = sides;
  }
  BoundaryFaces anew;
  anew.resize(1000);
  for (const auto& [key, sides] : expected) anew.set(face(key, sides), corners(key, sides));
  EXPECT_TRUE(drawn == anew);
  EXPECT_EQ(drawn.count(), expected.size());
  auto at = expected.begin();
  drawn.for_each([&](const BoundaryFaces::Face& f, std::span<const BoundaryFaces::Corner> c) {
    EXPECT_EQ(f.first.value, at->first);
    EXPECT_EQ(c.size(), at->second);
    for (const auto& corner : c) EXPECT_EQ(corner.vertex, at->first);
    ++at;
  });
}

} // namespace
} // namespace rend::hull_test
