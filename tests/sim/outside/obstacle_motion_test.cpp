// Prescribed motions of obstacles, against elementary geometry.
#include "sim/outside/obstacle_motion.h"

#include "sim/base/math.h"
#include "sim/outside/obstacle.h"
#include "sim/presets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rend::obstacle_motion_test {
namespace {

const Vec3 middle(0.5, -1, 2);

Vec3 place(const ObstacleMotion& motion, double time) {
  return motion.at(middle, time).of(middle);
}

ObstacleKey at(double time, const Vec3& position) {
  return {.at = time, .position = position};
}

TEST(ObstacleMotion, without_one_every_point_stays_to_the_bit) {
  const Pose pose = ObstacleMotion{}.at(middle, 3);
  const Vec3 x(0.1, 1e-300, -1e300);
  EXPECT_EQ(pose.of(x), x);
  EXPECT_EQ(pose.back(x), x);
  EXPECT_FALSE(ObstacleMotion{}.moves());
}

TEST(ObstacleMotion, moves_evenly_with_a_velocity) {
  const ObstacleMotion motion{.velocity = {1, -2, 3}};
  EXPECT_EQ(place(motion, 0.5), middle + Vec3(0.5, -1, 1.5));
}

TEST(ObstacleMotion, turns_about_an_axis_through_its_middle_or_another_point) {
  ObstacleMotion motion{.rotate = std::array<double, 4>{1, 2, 2, 90}};
  const Vec3 x(3, 1, 4), axis = Vec3(1, 2, 2) / 3;
  const auto turned = [&](const Vec3& about, double angle) {
    return Vec3(about + Eigen::AngleAxisd(angle * pi / 180, axis) * (x - about));
  };
  for (double time : {0.0, 0.3, 1.0, 7.7}) {
    EXPECT_LT((motion.at(middle, time).of(x) - turned(middle, 90 * time)).norm(), 1e-13);
    EXPECT_LT((motion.at(middle, time).back(motion.at(middle, time).of(x)) - x).norm(), 1e-13);
  }
  motion.centre = Vec3(-1, 0, 0);
  EXPECT_LT((motion.at(middle, 0.3).of(x) - turned({-1, 0, 0}, 27)).norm(), 1e-13);
}

TEST(ObstacleMotion, is_at_its_keys_at_their_times_and_stays_at_the_last) {
  const ObstacleMotion motion{.keys = {at(0.5, {0, 0, 1}), at(1, {0, 2, 1}), at(3, {5, 2, 1})}};
  EXPECT_EQ(place(motion, 0), middle) << "from its own place";
  EXPECT_EQ(place(motion, 0.5), Vec3(0, 0, 1));
  EXPECT_EQ(place(motion, 1), Vec3(0, 2, 1));
  EXPECT_EQ(place(motion, 3), Vec3(5, 2, 1));
  EXPECT_EQ(place(motion, 30), Vec3(5, 2, 1));
  const ObstacleMotion starts_elsewhere{.keys = {at(0, {0, 0, 1}), at(1, {0, 2, 1})}};
  EXPECT_EQ(place(starts_elsewhere, 0), Vec3(0, 0, 1));
}

// Between two keys: x = L (3 s² − 2 s³).
TEST(ObstacleMotion, starts_and_ends_at_rest) {
  const ObstacleMotion motion{.keys = {at(1, middle), at(3, middle + Vec3(4, 0, 0))}};
  for (double s : {0.1, 0.25, 0.5, 0.9})
    EXPECT_NEAR(place(motion, 1 + 2 * s).x() - middle.x(), 4 * s * s * (3 - 2 * s), 1e-14);
}

TEST(ObstacleMotion, by_keys_has_no_jumps_of_velocity_and_overshoots_nowhere) {
  const std::vector<double> times{0.2, 0.5, 0.6, 1.4, 2, 2.1}, x{0, 1, 1, -0.5, 3, 3.2};
  ObstacleMotion motion;
  for (std::size_t n = 0; n < times.size(); ++n) motion.keys.push_back(at(times[n], {x[n], 0, 0}));
  const auto along = [&](double time) { return place(motion, time).x(); };
  constexpr double h = 1e-6;
  for (double time : times)
    EXPECT_NEAR((along(time + h) - along(time)) / h, (along(time) - along(time - h)) / h, 1e-3) << time;
  for (std::size_t n = 0; n + 1 < times.size(); ++n)
    for (double share = 0; share <= 1; share += 0.02) {
      const double now = along(times[n] + share * (times[n + 1] - times[n]));
      EXPECT_GE(now, std::min(x[n], x[n + 1]) - 1e-12);
      EXPECT_LE(now, std::max(x[n], x[n + 1]) + 1e-12);
    }
  EXPECT_EQ(along(0.55), 1) << "it stands still between equal keys";
}

// Of four keys on a line of even speed, the middle one is passed at that speed.
TEST(ObstacleMotion, by_keys_of_even_speed_is_even_between_the_second_and_the_last_but_one) {
  ObstacleMotion motion;
  for (int n = 0; n < 5; ++n) motion.keys.push_back(at(n, {2.0 * n, 0, 0}));
  for (double time : {1.0, 1.3, 2.0, 2.9}) EXPECT_NEAR(place(motion, time).x(), 2 * time, 1e-13);
}

TEST(ObstacleMotion, takes_angles_of_keys_as_a_place_does) {
  ObstacleMotion motion;
  motion.keys = {{.at = 0, .rotate = Vec3(0, 0, 0)}, {.at = 2, .rotate = Vec3(30, 400, -70)}};
  const auto about = [](double degrees, const Vec3& axis) {
    return Eigen::AngleAxisd(degrees * pi / 180, axis);
  };
  for (double share : {0.5, 1.0}) {
    const Eigen::Matrix3d expected = (about(-70 * share, Vec3::UnitZ()) * about(400 * share, Vec3::UnitY()) *
                                      about(30 * share, Vec3::UnitX()))
                                         .toRotationMatrix();
    EXPECT_LT((motion.at(middle, 2 * share).turn - expected).norm(), 1e-13);
  }
}

// A coordinate that a key does not give goes on between those that do.
TEST(ObstacleMotion, keys_may_give_places_and_angles_at_different_times) {
  ObstacleMotion motion;
  motion.keys = {at(0, middle), {.at = 1, .rotate = Vec3(0, 0, 90)}, at(2, middle + Vec3(1, 0, 0))};
  EXPECT_NEAR(place(motion, 1).x(), middle.x() + 0.5, 1e-14);
  EXPECT_LT((motion.at(middle, 5).turn * Vec3::UnitX() - Vec3::UnitY()).norm(), 1e-14);
}

// The surface's mean velocity over a step takes a material point from where it was to where it is.
TEST(ObstacleMotion, a_surface_has_the_velocity_of_its_material_points) {
  const ObstacleMotion motion{.velocity = {0.3, 0, 0}, .rotate = std::array<double, 4>{0, 0, 2, 100}};
  const RigidStep step{motion.at(middle, 0.7), motion.at(middle, 0.71), 0.01};
  const Vec3 X(1, 1, 1), x = step.to.of(X);
  EXPECT_LT((x - 0.01 * step.velocity(x) - step.from.of(X)).norm(), 1e-14);
  const Vec3 arm = x - place(motion, 0.71), spin(0, 0, 100 * pi / 180);
  const double chord = 0.5 * spin.squaredNorm() * arm.norm() * 0.01; // to first order
  EXPECT_LT((step.velocity(x) - Vec3(0.3, 0, 0) - spin.cross(arm)).norm(), 1.01 * chord);
}

void expect_refused(const std::string& obstacle, const std::string& what) {
  try {
    presets::load(R"(<scene><body><sheet cells="1 1" size="1 1"/><mass total="1"/><contact/></body><world>)" +
                  obstacle + R"(</world><time step="0.01" duration="1"/></scene>)");
    ADD_FAILURE() << obstacle;
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(what)) << obstacle;
  }
}

TEST(ObstacleMotion, refuses_what_does_not_fit_together) {
  const std::string box = R"(<box low="0 0 -3" high="1 1 -2")",
                    sphere = R"(<sphere centre="0 0 -3" radius="1")";
  expect_refused(box + R"(><key at="1" position="0 0 1"/><key at="1" position="0 0 2"/></box>)",
                 "this key and the one before it both come at 1 s");
  expect_refused(box + R"(><key at="1"/></box>)", "neither where");
  expect_refused(box + R"( velocity="1 0 0"><key at="1" position="0 0 1"/></box>)", "velocity cannot be used");
  expect_refused(box + R"( rotate="0 0 1 9"><key at="1" rotate="0 0 1"/></box>)", "rotate cannot be used");
  expect_refused(box + R"( rotate="0 0 0 9"/>)", "no direction");
  expect_refused(box + R"( centre="0 0 0"/>)", "no use without rotate");
  expect_refused(sphere + R"( mass="1"><key at="1" position="0 0 1"/></sphere>)", "it falls");
  expect_refused(sphere + R"( mass="1" rotate="0 0 1 9"/>)", "it falls");
}

} // namespace
} // namespace rend::obstacle_motion_test
