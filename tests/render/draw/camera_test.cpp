#include "render/draw/camera.h"

#include "sim/base/check.h"

#include <gtest/gtest.h>

namespace rend::camera_test {
namespace {

using Eigen::Vector3d;

Vector3d seen(const View& view, const Vector3d& point) {
  return (view.world_to_clip() * point.homogeneous()).hnormalized();
}

TEST(Camera, SeesItsTargetInTheMiddleAndUpUpwards) {
  FrameCamera camera;
  camera.eye = {1, -2, 3};
  camera.target = {0, 1, 0.5};
  const View view = view_of(camera, {}, 1.5);
  EXPECT_LT(seen(view, camera.target).head<2>().norm(), 1e-12);
  const Vector3d above = seen(view, camera.target + Vector3d(0, 0, 0.1));
  EXPECT_GT(above.y(), 0);
  EXPECT_NEAR(above.x(), 0, 1e-12);
}

TEST(Camera, ShowsItsVerticalAngleFromBottomToTop) {
  FrameCamera camera;
  camera.eye = {0, -2, 0};
  camera.fov = 90;
  const View view = view_of(camera, {}, 2);
  EXPECT_NEAR(seen(view, {0, 0, 2}).y(), 1, 1e-12);
  EXPECT_NEAR(seen(view, {4, 0, 0}).x(), 1, 1e-12);
}

TEST(Camera, KeepsTheDepthOfAllBoundsInRange) {
  FrameCamera camera;
  camera.eye = {0, -10, 0};
  const Eigen::AlignedBox3d bounds(Vector3d(-1, -2, -1), Vector3d(1, 30, 1));
  const View view = view_of(camera, bounds, 1);
  for (int i = 0; i < 8; ++i) {
    const double depth = seen(view, bounds.corner(Eigen::AlignedBox3d::CornerType(i))).z();
    EXPECT_GT(depth, -1);
    EXPECT_LT(depth, 1);
  }
}

TEST(Camera, LooksStraightDownWithoutLosingItsHead) {
  FrameCamera camera;
  camera.eye = {0, 0, 5};
  const View view = view_of(camera, {}, 1);
  EXPECT_TRUE(view.world_to_clip().allFinite());
  EXPECT_LT(seen(view, camera.target).head<2>().norm(), 1e-12);
}

TEST(Camera, RefusesNumbersThatAreNotFinite) {
  FrameCamera camera;
  camera.eye.x() = std::nan("");
  EXPECT_THROW(view_of(camera, {}, 1), InternalError);
}

TEST(FrameAuto, KeepsTheBoxInSightFromAnyDirectionAndFillsMostOfThePicture) {
  const Eigen::AlignedBox3d box(Vector3d(-1, 2, 0), Vector3d(3, 2.5, 1));
  for (const Vector3d& direction :
       {Vector3d(0, -1, 0), Vector3d(1, 1, 1), Vector3d(0, 0, 1), Vector3d(-3, 0.1, -1)})
    for (const double aspect : {0.5, 1.0, 1.7778}) {
      const View view = view_of(fit_camera(box, 35, aspect, direction), box, aspect);
      double reach = 0;
      for (int i = 0; i < 8; ++i)
        reach = std::max(
            reach, seen(view, box.corner(Eigen::AlignedBox3d::CornerType(i))).head<2>().cwiseAbs().maxCoeff());
      EXPECT_LT(reach, 0.95);
      EXPECT_GT(reach, 0.8);
    }
}

TEST(FrameAuto, LooksAtASinglePoint) {
  const FrameCamera camera = fit_camera(Eigen::AlignedBox3d(Vector3d(1, 2, 3)), 35, 1, {0, -1, 0});
  EXPECT_EQ(camera.target, Vector3d(1, 2, 3));
  EXPECT_GT((camera.eye - camera.target).norm(), 0);
}

} // namespace
} // namespace rend::camera_test
