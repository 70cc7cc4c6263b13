// The surface during a run that tears, and on a non-orientable band.
#include "sim/boundary/surface.h"

#include "sim/presets.h"

#include <cmath>
#include <gtest/gtest.h>

namespace rend::surface_run_test {
namespace {

TEST(SurfaceOfARun, equals_a_new_one_after_every_step_that_tears) {
  for (const char* pattern : {"quads", "triangles", "crossed", "mixed"}) {
    const auto scene = presets::load(
        presets::cloth(pattern, 8, R"(<tear criterion="global-border" threshold="0.03" max-per-step="2"/>)"));
    Surface surface(*scene.body().map, scene.body().border);
    std::size_t tears = 0;
    int changes = 0;
    for (int n = 0; n < 300; ++n) {
      scene->step();
      surface.update();
      if (scene->tears() == tears) continue;
      tears = scene->tears();
      ++changes;
      ASSERT_TRUE(surface.same_as(Surface(*scene.body().map, scene.body().border)))
          << pattern << ", step " << n;
    }
    EXPECT_GT(changes, 2) << pattern;
  }
}

TEST(SurfaceOfARun, keeps_its_triangles_and_shows_two_torn_sides_a_tear) {
  const auto scene =
      presets::load(presets::cloth("mixed", 8, R"(<tear criterion="global-border" threshold="0.05"/>)"));
  Surface surface(*scene.body().map, scene.body().border);
  const std::size_t triangles = surface.triangles();
  EXPECT_EQ(triangles, 32u * 2 + 32u * 4);
  for (int n = 0; n < 300; ++n) scene->step();
  surface.update();
  std::size_t torn = 0, border = 0;
  surface.for_each_triangle([&](const BoundaryTriangle& t) {
    for (LineKind side : t.side) {
      torn += side == LineKind::Torn;
      border += side == LineKind::Border;
    }
  });
  EXPECT_EQ(surface.triangles(), triangles);
  EXPECT_EQ(torn, 2 * scene->tears());
  EXPECT_EQ(border, 4u * 8);
}

// Neighbours on a smooth band have nearly the same normal, up to its sign; also across the seam.
TEST(SurfaceOfAMoebiusBand, has_normals_that_are_continuous_up_to_their_sign) {
  for (const char* pattern : {"quads", "triangles", "crossed", "mixed"}) {
    const auto scene = presets::load(std::string(R"(<scene><body><sheet pattern=")") + pattern +
                                     R"(" cells="80 6" size="3 0.3" close="twist"/><mass total="1"/></body>
                                     <time step="1" duration="1"/></scene>)");
    const Surface surface(*scene.body().map, scene.body().border);
    std::vector<Vec3> normals;
    surface.normals(normals);
    for (const Vec3& n : normals) ASSERT_NEAR(n.norm(), 1, 1e-12);
    const GMap& map = scene.body().map->map();
    map.for_each_dart([&](Dart d) {
      const Vec3 &a = normals[scene.body().map->vertex(d)],
                 &b = normals[scene.body().map->vertex(map.alpha(0, d))];
      EXPECT_GT(std::abs(a.dot(b)), 0.97) << pattern;
    });
  }
}

TEST(SurfaceOfACollapsedSheet, has_no_normals_and_no_nan) {
  const auto scene = presets::load(presets::cloth("mixed", 4));
  for (Record& x : scene.body().map->position().values()) x = Record(1, 2, 3);
  std::vector<Vec3> normals;
  Surface(*scene.body().map, scene.body().border).normals(normals);
  for (const Vec3& n : normals) EXPECT_EQ(n, Vec3::Zero());
}

} // namespace
} // namespace rend::surface_run_test
