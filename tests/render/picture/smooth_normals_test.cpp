// A crossed sheet whose middles stand out of a surface is shaded nearly as the surface.
#include "render/picture/scene_preset.h"
#include "render/picture/smooth_normals.h"
#include "sim/boundary/boundary.h"
#include "sim/build/build_scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rend::smooth_normals_test {
namespace {

struct Sheet {
  std::unique_ptr<PresetNode> preset;
  std::unique_ptr<Scene> scene;
  Sheet()
      : preset(load_scene_text(R"(<scene name="s"><body><sheet pattern="crossed" cells="12 12" size="1.2 1.2"/>
                                  <mass total="1"/><springs><stretch k="1"/></springs></body>
                                  <time duration="1"/></scene>)",
                               "s.xml")),
        scene(std::make_unique<Scene>(read_scene(*preset), SceneOptions{})) {}
  Body& body() { return *scene->bodies()[0]; }

  // Puts each vertex where `to` says, given its rest position and whether it is the middle of a cell.
  template <class F> void shape(F&& to) {
    auto& x = body().map->position();
    for (Slot v = 0; v < body().map->cells(Vertex).slots(); ++v) {
      const Vec3 rest = body().map->rest()[v].vec();
      const bool middle = std::abs(std::remainder(rest.x(), 0.1)) > 0.01;
      x[v] = Record(to(rest, middle));
    }
  }
  // The largest angle between normals and those of `smooth`, at a distance from the border [radians].
  template <class F> double off(bool smoothed, F&& smooth) {
    std::vector<Vec3> normals, sums;
    const Surface& surface = body().boundary().sheet();
    surface.normals(normals);
    if (smoothed) smooth_normals(surface, body().map->position().values(), normals, sums);
    double worst = 0;
    for (Slot v = 0; v < body().map->cells(Vertex).slots(); ++v) {
      const Vec3 rest = body().map->rest()[v].vec();
      if ((rest - Vec3(0.6, 0.6, 0)).cwiseAbs().maxCoeff() > 0.35) continue;
      worst = std::max(worst, std::acos(std::min(1.0, std::abs(normals[v].dot(smooth(rest))))));
    }
    return worst;
  }
};

TEST(SmoothNormals, do_not_show_the_cells_of_a_crossed_sheet_along_a_fold) {
  Sheet sheet; // on a slope, so that middles and corners have other normals
  const auto wave = [](double x) { return 0.1 * std::sin(5 * x); };
  sheet.shape([&](const Vec3& rest, bool middle) {
    return Vec3(rest.x(), rest.y(),
                wave(rest.x()) + (middle ? 0.02 * std::cos(5 * rest.x()) * std::sin(20 * rest.y()) : 0));
  });
  const auto smooth = [](const Vec3& rest) { return Vec3(-0.5 * std::cos(5 * rest.x()), 0, 1).normalized(); };
  const double before = sheet.off(false, smooth), after = sheet.off(true, smooth);
  EXPECT_GT(before, 0.1);
  EXPECT_LT(after, 0.5 * before);
}

TEST(SmoothNormals, of_a_cylinder_stay_those_of_a_cylinder) {
  Sheet sheet;
  constexpr double radius = 0.5;
  sheet.shape([](const Vec3& rest, bool) {
    const double angle = rest.x() / radius;
    return Vec3(radius * std::sin(angle), rest.y(), radius * std::cos(angle));
  });
  const auto smooth = [](const Vec3& rest) {
    return Vec3(std::sin(rest.x() / radius), 0, std::cos(rest.x() / radius));
  };
  EXPECT_LT(sheet.off(true, smooth), 0.01);
}

} // namespace
} // namespace rend::smooth_normals_test
