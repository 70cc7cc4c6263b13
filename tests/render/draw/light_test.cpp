#include "render/draw/light.h"

#include <gtest/gtest.h>

namespace rend::light_test {
namespace {

using Eigen::Vector3d;

const Vector3d towards = Vector3d(-0.5, -0.4, 0.7).normalized();

Vector3d seen(const LightView& view, const Vector3d& point) {
  return (view.world_to_clip * point.homogeneous()).head<3>();
}

TEST(LightView, CoversTheBoundsWithARimToSpare) {
  for (const double size : {1e-3, 0.7, 1.0, 1.01, 50.0}) {
    const Eigen::AlignedBox3d box(Vector3d(-size, 2, 0), Vector3d(size, 2 + size, 3 * size));
    const LightView view = light_view(towards, box);
    for (int i = 0; i < 8; ++i) {
      const Vector3d corner = seen(view, box.corner(Eigen::AlignedBox3d::CornerType(i)));
      EXPECT_LT(corner.cwiseAbs().maxCoeff(), 0.99) << size;
    }
  }
}

TEST(LightView, PutsWhatIsNearerToTheLightInFront) {
  const Eigen::AlignedBox3d box(Vector3d(-1, -1, -1), Vector3d(1, 1, 1));
  const LightView view = light_view(towards, box);
  EXPECT_LT(seen(view, 0.5 * towards).z(), seen(view, -0.5 * towards).z());
}

TEST(LightView, MovesByWholeTexelsWhenABodyMovesALittle) {
  const Eigen::AlignedBox3d box(Vector3d(0, 0, 0), Vector3d(1, 1, 1));
  const LightView still = light_view(towards, box);
  for (int i = 1; i < 40; ++i) {
    const Eigen::AlignedBox3d moved = box.translated(Vector3d(0.013, -0.007, 0.004) * i);
    const LightView view = light_view(towards, moved);
    ASSERT_EQ(view.half, still.half);
    const Eigen::Vector2d texels = (seen(view, {0, 0, 0}) - seen(still, {0, 0, 0})).head<2>() * 16; // of 32
    EXPECT_NEAR(texels.x(), std::round(texels.x()), 1e-9);
    EXPECT_NEAR(texels.y(), std::round(texels.y()), 1e-9);
  }
}

TEST(LightView, GrowsInStepsOfRootTwo) {
  const auto half = [](double size) {
    return light_view(towards, {Vector3d::Zero(), Vector3d::Constant(size)}).half;
  };
  EXPECT_EQ(half(1.0), half(1.001));
  const double steps = 2 * std::log2(half(1.5) / half(1.0));
  EXPECT_NEAR(steps, std::round(steps), 1e-12);
  EXPECT_EQ(half(2.0), 2 * half(1.0));
}

TEST(Lights, StandWhereTheFrameSays) {
  Frame frame;
  frame.light = Vector3d(0, 3, 4);
  EXPECT_LT((lights_of(frame).key - Vector3d(0, 0.6, 0.8)).norm(), 1e-12);
}

TEST(Lights, AreUnitAndAboveTheFloorForAnyCamera) {
  for (const Vector3d& eye : {Vector3d(3, -3, 2), Vector3d(0, 0, 4), Vector3d(0, -2, -3)}) {
    Frame frame;
    frame.camera.eye = eye;
    frame.floor = FrameFloor{};
    frame.light = eye.z() < 0 ? std::optional<Vector3d>(Vector3d(1, 0, -5)) : std::nullopt;
    const Lights lights = lights_of(frame);
    EXPECT_NEAR(lights.key.norm(), 1, 1e-12);
    EXPECT_NEAR(lights.fill.norm(), 1, 1e-12);
    EXPECT_GT(lights.key.z(), 0.1);
  }
}

TEST(LitBounds, LeaveOutWhatFliesFarOutOfSight) {
  FrameCamera camera;
  const Eigen::AlignedBox3d all(Vector3d(-1, -1, -1000), Vector3d(1, 1, 1));
  EXPECT_LT(lit_bounds(camera, 1.5, all).sizes().z(), 20);
  EXPECT_FALSE(lit_bounds(camera, 1.5, {}).isEmpty());
}

} // namespace
} // namespace rend::light_test
