// A moving camera: keyed, and following the bodies.
#include "render/picture/viewpoint.h"
#include "sim/build/build_scene.h"

#include "render/draw/camera.h"
#include "render/picture/scene_preset.h"

#include <gtest/gtest.h>

namespace rend::viewpoint_test {
namespace {

std::unique_ptr<PresetNode> scene_with(const std::string& camera, const std::string& hold = "") {
  return load_scene_text(R"(<scene name="seen"><body><sheet cells="6 6" size="1 1"/><mass total="0.1"/>)"
                         R"(<springs><stretch k="60"/><shear kind="isotropic" k="43"/></springs>)" +
                             hold + "</body>" + R"(<time step="2e-3" duration="2"/>)" + camera + "</scene>",
                         "seen.xml");
}

TEST(Viewpoint, keys_are_met_and_held_at_the_ends) {
  const auto preset =
      scene_with(R"(<camera fov="30"><key at="0.5" eye="3 0 1"/><key at="1" eye="0 -4 2" target="0 0 1"/>)"
                 R"(<key at="2" eye="-3 0 1" fov="50"/></camera>)");
  const Scene scene(read_scene(*preset), {});
  const Viewpoint view(picture_settings(*preset).camera, scene, 1.5, 2);
  EXPECT_EQ(view.at(0).eye, Vec3(3, 0, 1));
  EXPECT_EQ(view.at(0.5).eye, Vec3(3, 0, 1));
  EXPECT_NEAR((view.at(1).eye - Vec3(0, -4, 2)).norm(), 0, 1e-12);
  EXPECT_NEAR((view.at(1).target - Vec3(0, 0, 1)).norm(), 0, 1e-12);
  EXPECT_EQ(view.at(3).eye, Vec3(-3, 0, 1));
  EXPECT_EQ(view.at(3).fov, 50);
  EXPECT_EQ(view.at(1).fov, 30);
}

TEST(Viewpoint, between_keys_it_neither_jumps_nor_jerks) {
  const auto preset = scene_with(R"(<camera><key at="0" eye="3 0 1"/><key at="0.4" eye="0 -4 2"/>)"
                                 R"(<key at="2" eye="-3 0 1"/></camera>)");
  const Scene scene(read_scene(*preset), {});
  const Viewpoint view(picture_settings(*preset).camera, scene, 1.5, 2);
  constexpr double h = 1e-3;
  Vec3 last = Vec3::Zero();
  for (double t = 0; t < 2; t += h) {
    const Vec3 velocity = (view.at(t + h).eye - view.at(t).eye) / h;
    EXPECT_LT((velocity - last).norm(), 0.3) << t; // accelerations of some 100 m/s²
    last = velocity;
  }
}

// On a sensor of 36 mm the usual lens sees 39.6 degrees from side to side.
TEST(Viewpoint, a_lens_says_how_wide_the_angle_of_view_is) {
  const auto preset =
      scene_with(R"(<camera eye="0 -4 2" lens="50"><key at="0" eye="3 0 1" lens="85"/></camera>)");
  const Scene scene(read_scene(*preset), {});
  CameraSettings camera = picture_settings(*preset).camera;
  EXPECT_NEAR(Viewpoint(camera, scene, 1.5, 2).at(0).fov, 16.071, 1e-3); // 2 atan(12 / 85)
  camera.keys.clear();
  EXPECT_NEAR(Viewpoint(camera, scene, 1.5, 2).at(0).fov, 26.991, 1e-3);      // 2 atan(12 / 50)
  EXPECT_NEAR(Viewpoint(camera, scene, 16 / 9.0, 2).at(0).fov, 22.895, 1e-3); // 2 atan(10.125 / 50)
  EXPECT_NEAR(Viewpoint(camera, scene, 9 / 16.0, 2).at(0).fov, 39.598, 1e-3); // 2 atan(18 / 50)
  EXPECT_THROW(scene_with(R"(<camera eye="0 -4 2" lens="50" fov="30"/>)"), UserError);
  camera.lens = 2000; // 0.69 degrees
  EXPECT_THROW(Viewpoint(camera, scene, 1.5, 2), UserError);
  camera.lens = 1; // 173.6 degrees
  EXPECT_THROW(Viewpoint(camera, scene, 9 / 16.0, 2), UserError);
}

TEST(Viewpoint, keys_out_of_order_are_refused) {
  const auto preset = scene_with(R"(<camera><key at="1" eye="3 0 1"/><key at="1" eye="0 -4 2"/></camera>)");
  const Scene scene(read_scene(*preset), {});
  EXPECT_THROW(Viewpoint(picture_settings(*preset).camera, scene, 1.5, 2), UserError);
}

// The body falls twice its own size: every vertex stays inside the picture.
TEST(Viewpoint, one_that_follows_loses_nothing_out_of_sight) {
  const auto preset = scene_with(R"(<camera frame="follow"/>)", R"(<fix near="0 0 0"/>)");
  Scene scene(read_scene(*preset), {});
  Viewpoint view(picture_settings(*preset).camera, scene, 1.5, 2);
  const Vec3 start = view.at(0).target;
  for (int frame = 0; frame < 60; ++frame) {
    view.observe(scene);
    const View seen = view_of(view.at(scene.time()), {}, 1.5);
    const Body& body = *scene.bodies()[0];
    for (Slot v = 0; v < body.map->cells(Vertex).slots(); ++v) {
      const Eigen::Vector4d at = seen.world_to_clip() * body.map->position()[v].vec().homogeneous();
      ASSERT_LT(std::abs(at.x() / at.w()), 1) << frame;
      ASSERT_LT(std::abs(at.y() / at.w()), 1) << frame;
    }
    for (int n = 0; n < 16; ++n) scene.step();
  }
  EXPECT_GT((view.at(0).target - start).norm(), 0.2);
}

} // namespace
} // namespace rend::viewpoint_test
