// Contact with obstacles that move as prescribed: against Coulomb's and Newton's laws, and the energy account.
#include "sim/base/archive.h"
#include "sim/base/math.h"
#include "sim/presets.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace rend::moving_obstacle_test {
namespace {

using presets::Loaded;

void run(const Loaded& scene, double until) {
  while (scene->time() < until - 1e-9) scene->step();
}

Vec3 mean_velocity(const Loaded& scene) {
  return total_momentum(*scene.body().map, *scene.body().mass) /
         total_mass(*scene.body().map, *scene.body().mass);
}

Vec3 mean_position(const Loaded& scene) {
  Vec3 sum = Vec3::Zero();
  for (const Record& x : scene.body().map->position().values()) sum += x.vec();
  return sum / static_cast<double>(scene.body().vertices());
}

// A stiff block on a box whose top is at 0.5.
Loaded block(const std::string& box, const std::string& at = "0 0 0.502",
             const std::string& gravity = "0 0 -10") {
  return presets::load(R"(<scene><body><bar cells="1 1 1" size="0.2 0.2 0.05"/><place translate=")" + at +
                       R"("/><mass total="1"/>
      <elasticity model="corotational" young="2e4" poisson="0" damping-stiffness="0.01"/><contact/></body>
      <world gravity=")" +
                       gravity + "\">" + box +
                       R"(</world><time step="2e-4" duration="4" integrator="symplectic"/></scene>)");
}

// x = L (3 s² − 2 s³) from 0.3 s on, in 1 s: it accelerates by A (1 − 2 s), A = 6 L/s².
Loaded on_an_accelerating_box(double acceleration, double friction) {
  return block(fmt::format(R"(<box low="-1 -1 0" high="1 1 0.5" friction="{}">
      <key at="0.3" position="0 0 0.25"/><key at="1.3" position="{} 0 0.25"/></box>)",
                           friction, acceleration / 6));
}

TEST(MovingObstacle, a_block_is_carried_by_a_box_that_accelerates_less_than_friction_allows) {
  const Loaded carried = on_an_accelerating_box(8, 0.9); // 9 m/s²
  run(carried, 0.3);
  const double start = mean_position(carried).x();
  for (double time : {0.4, 0.7, 1.0, 1.3}) {
    run(carried, time);
    const double s = time - 0.3;
    EXPECT_NEAR(mean_position(carried).x() - start, 8.0 / 6 * s * s * (3 - 2 * s), 2e-3) << time;
  }
  run(carried, 1.5);
  EXPECT_LT(mean_velocity(carried).norm(), 1e-3) << "it stands still with the box";
}

// μ g = A/2: it slides until the box is as slow as it is, half-way, and is then A T²/48 behind.
TEST(MovingObstacle, a_block_slides_on_a_box_that_accelerates_more_and_as_coulomb_says) {
  const Loaded slides = on_an_accelerating_box(8, 0.4); // 4 m/s²
  run(slides, 0.3);
  const double start = mean_position(slides).x();
  for (double s : {0.1, 0.2, 0.4}) {
    run(slides, 0.3 + s);
    EXPECT_NEAR(mean_velocity(slides).x(), 4 * s, 0.02 * 4 * s) << s;
  }
  run(slides, 0.8);
  const double box = 8.0 / 6 * 0.5;
  EXPECT_NEAR(mean_position(slides).x() - start - box, -8.0 / 48, 0.02 * 8 / 48);
}

TEST(MovingObstacle, a_turning_table_carries_what_friction_can_hold_on_a_circle) {
  // ω = 2 rad/s, at 0.5 m: ω² r = 2 m/s²
  const std::string table =
      R"(<box low="-2 -2 0" high="2 2 0.5" rotate="0 0 1 114.591559026165" friction="{}"/>)";
  const Loaded held = block(fmt::format(fmt::runtime(table), 1.0), "0.4 -0.1 0.502");
  run(held, 0.4); // until it turns with the table
  const Vec3 before = mean_position(held);
  run(held, 1.4);
  const Vec3 after = mean_position(held);
  const double radius = before.head<2>().norm(),
               angle = std::atan2(after.y(), after.x()) - std::atan2(before.y(), before.x());
  EXPECT_NEAR(after.head<2>().norm(), radius, 2e-3);
  EXPECT_NEAR(angle, 2, 0.01);
  EXPECT_NEAR(mean_velocity(held).head<2>().norm(), 2 * radius, 0.02);
  const Loaded lost = block(fmt::format(fmt::runtime(table), 0.02), "0.4 -0.1 0.502");
  run(lost, 1.4);
  EXPECT_NEAR(mean_position(lost).head<2>().norm(), 0.5, 0.3);
  EXPECT_LT(mean_velocity(lost).norm(), 0.02 * 10 * 1.4 + 1e-3) << "friction gives no more";
}

TEST(MovingObstacle, a_lift_without_friction_takes_its_load_to_its_own_velocity) {
  const Loaded lift = block(R"(<box low="-1 -1 0" high="1 1 0.5" velocity="0 0 0.7" friction="0"/>)");
  run(lift, 2);
  EXPECT_LT((mean_velocity(lift) - Vec3(0, 0, 0.7)).norm(), 1e-3);
  EXPECT_NEAR(mean_position(lift).z(), 0.502 + 0.025 + 1.4, 2e-3);
}

// The top of a large sphere that turns about y goes along x, at ω R = 0.3 m/s.
TEST(MovingObstacle, a_turning_sphere_drags_what_lies_on_it) {
  const Loaded drags =
      block(R"(<sphere centre="0 0 -29.5" radius="30" rotate="0 1 0 0.57295779513082" friction="0.1"/>)",
            "-0.1 -0.1 0.503");
  run(drags, 0.1);
  const double before = mean_velocity(drags).x(), from = drags->time();
  run(drags, 0.25);
  EXPECT_NEAR((mean_velocity(drags).x() - before) / (drags->time() - from), 0.1 * 10, 0.05);
  run(drags, 1);
  EXPECT_NEAR(mean_velocity(drags).x(), 0.3, 0.01);
}

// The blade is thinner than its way in a step, here 12 to 63 mm; the flake lies a quarter of a turn ahead.
TEST(MovingObstacle, a_fast_thin_blade_does_not_pass_what_is_in_its_way) {
  for (const char* radius : {"0.2", "0.6", "0.95"}) {
    const Loaded scene = presets::load(
        std::string(R"(<scene><body><sheet cells="1 1" size="0.001 0.001"/><place translate="0 )") + radius +
        R"( 0"/><mass total="0.01"/><springs><stretch k="0.01"/></springs>
        <contact thickness="0.001" friction="0"/></body><world gravity="0 0 0">
        <box low="-1 -0.002 -0.1" high="1 0.002 0.1" rotate="0 0 1 720"/></world>
        <time step="5e-3" duration="1"/></scene>)");
    run(scene, 0.1);
    EXPECT_EQ(mean_velocity(scene), Vec3::Zero()) << radius;
    run(scene, 0.13);
    const double speed = 4 * pi * std::stod(radius);
    EXPECT_NEAR(mean_velocity(scene).x(), -speed, 0.1 * speed) << radius;
  }
}

TEST(MovingObstacle, a_falling_sphere_comes_to_rest_on_a_lift_and_a_belt_takes_it_along) {
  const Loaded scene = presets::load(R"(<scene><body><sheet cells="1 1" size="0.1 0.1"/><mass total="1"/>
      <fix all="yes"/><contact/></body><world>
      <box low="2 0 0" high="3 1 0.5" velocity="0 0 0.5"/>
      <sphere centre="2.5 0.5 0.65" radius="0.1" mass="2"/>
      <box low="2 4 0" high="9 5 0.5" velocity="1.5 0 0" friction="0.2"/>
      <sphere centre="5 4.5 0.6" radius="0.1" mass="1" friction="0.2"/></world>
      <time step="5e-4" duration="1"/></scene>)");
  const auto& spheres = scene->world().spheres;
  run(scene, 0.5);
  EXPECT_NEAR(spheres[1].velocity.x(), 0.2 * 9.81 * 0.5, 2e-3);
  run(scene, 1);
  EXPECT_NEAR(spheres[1].velocity.x(), 1.5, 1e-9);
  EXPECT_NEAR(spheres[0].velocity.z(), 0.5, 1e-9);
  EXPECT_NEAR(spheres[0].centre.z(), 0.5 + 0.5 + 0.1, 1e-5);
}

// A sphere goes down into a sheet that is held at two sides, and stays there.
Loaded pushed_sheet(const std::string& step) {
  return presets::load(R"(<scene><body><sheet pattern="crossed" cells="8 8" size="1 1"/><mass total="0.2"/>
      <springs><stretch k="300"/><shear kind="isotropic" k="100"/></springs>
      <fix side="-x"/><fix side="+x"/><contact with="obstacles" friction="0"/></body>
      <world gravity="0 0 0"><sphere centre="0.5 0.5 0.25" radius="0.2">
      <key at="0.1" position="0.5 0.5 0.25"/><key at="0.9" position="0.5 0.5 -0.1"/></sphere></world>
      <time integrator="symplectic" step=")" +
                       step + R"(" duration="2"/></scene>)");
}

TEST(MovingObstacle, what_pushes_a_sheet_does_the_work_that_is_in_it) {
  const Loaded scene = pushed_sheet("2e-4");
  for (double time : {0.5, 0.9, 1.2}) {
    run(scene, time);
    const EnergyFigures e = scene->energy();
    EXPECT_LT(e.gained, 1e-2 * e.scale) << time;
    EXPECT_NEAR(e.now.kinetic + e.now.elastic, e.now.work.contact.obstacles - e.dissipated, 1e-2 * e.scale)
        << time;
  }
  const EnergyFigures e = scene->energy();
  EXPECT_GT(e.now.elastic, 1);
  EXPECT_LT(e.dissipated, 3e-2 * e.scale);
  EXPECT_NO_THROW(scene->check_account());
}

TEST(MovingObstacle, goes_on_from_a_stored_state_bit_for_bit) {
  const auto spinning = [] {
    return block(R"(<box low="-1 -1 0" high="1 1 0.5" rotate="0 0 1 90"><key at="0.1" position="0 0 0.25"/>
        <key at="0.3" position="0.1 0 0.2"/></box>
        <sphere centre="0.1 0.1 0.9" radius="0.1"><key at="0.4" position="0.1 0.1 0.6"/></sphere>)");
  };
  const Loaded first = spinning(), second = spinning();
  run(first, 0.15);
  Archive written;
  first->store(written);
  Archive read(std::span<const std::uint8_t>(written.bytes()));
  second->store(read);
  EXPECT_EQ(second->hash(), first->hash());
  run(first, 0.45);
  run(second, 0.45);
  EXPECT_EQ(second->hash(), first->hash());
  EXPECT_NEAR((second->world().spheres[0].centre - Vec3(0.1, 0.1, 0.6)).norm(), 0, 1e-12);
}

TEST(MovingObstacle, a_stored_sphere_that_left_its_keys_is_refused) {
  const Loaded moved = pushed_sheet("1e-3"), scene = pushed_sheet("1e-3");
  run(moved, 0.3);
  const_cast<Sphere&>(moved->world().spheres[0]).centre.x() += 0.01;
  Archive written;
  moved->store(written);
  Archive read(std::span<const std::uint8_t>(written.bytes()));
  EXPECT_THROW(scene->store(read), ArchiveError);
}

TEST(MovingObstacle, is_the_same_on_two_threads) {
  const auto hash = [](int threads) {
    const Loaded scene = presets::load(
        R"(<scene><body><sheet cells="20 20" size="1 1"/><mass total="0.2"/><springs><stretch k="80"/></springs>
        <contact/></body><world><box low="0 0.4 -0.2" high="1 0.6 -0.1" rotate="0.3 1 0 200"/></world>
        <time step="1e-3" duration="1"/></scene>)",
        {.threads = threads});
    run(scene, 0.2);
    return scene->hash();
  };
  EXPECT_EQ(hash(1), hash(2));
}

TEST(MovingObstacle, what_starts_in_a_box_as_it_is_turned_at_first_is_refused) {
  const auto start = [](const std::string& angle) {
    return block(R"(<box low="-1 -0.1 0.4" high="1 0.1 1"><key at="0" rotate="0 0 )" + angle + R"("/></box>)",
                 "0.5 0.4 0.5");
  };
  EXPECT_NO_THROW(start("0"));
  EXPECT_THROW(start("45"), UserError);
  EXPECT_NO_THROW(start("-45"));
}

} // namespace
} // namespace rend::moving_obstacle_test
