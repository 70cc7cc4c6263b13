// Contact inside the solve of implicit Euler: its forces against differences of its potential, and bodies at
// rest, on slopes and in impacts against what mechanics says of them.
#include "sim/outside/solved_contact.h"
#include "sim/presets.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace rend::solved_contact_test {
namespace {

using presets::load;
using presets::Loaded;

// A block of 10 kg, at rest on the floor; with ν = 0 its columns carry their weight each by itself.
std::string block(double step, const std::string& world, double friction = 0.5, double above = 0,
                  const std::string& more = "", const std::string& integrator = "implicit") {
  return fmt::format(R"(<scene><body><bar cells="4 4 2" size="0.4 0.4 0.2"/><place translate="0 0 {}"/>)"
                     R"(<mass total="10"/><elasticity young="1e5" poisson="0"/>)"
                     R"(<contact with="obstacles" friction="{}" thickness="0.001"/>{}</body>{})"
                     R"(<time integrator="{}" step="{}" duration="20"/></scene>)",
                     above + 0.001, friction, more, world, integrator, step);
}

const std::string floor_below = R"(<world><floor z="0"/></world>)";

void run(const Loaded& scene, double until) {
  while (scene->time() < until - 1e-9) scene->step();
}

// The mean height of vertices that rest in the layer at z [m].
double height_of(const Loaded& scene, double z) {
  const Body& body = scene.body();
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < body.vertices(); ++i) {
    if (std::abs(body.map->rest().values()[i].z - z) > 1e-6) continue;
    sum += body.map->position().values()[i].z;
    ++count;
  }
  return sum / count;
}

double lowest(const Loaded& scene) {
  double z = 1e300;
  for (const Record& x : scene.body().map->position().values()) z = std::min(z, x.z);
  return z;
}

class StepOf : public testing::TestWithParam<double> {};

// ρ g h²/2E = 0.613 mm, whatever the step.
TEST_P(StepOf, does_not_change_how_a_block_is_compressed_by_its_weight) {
  const Loaded scene = load(block(GetParam(), floor_below));
  run(scene, 6);
  const double expected = 10 * 9.81 / (0.4 * 0.4) * 0.2 / (2 * 1e5);
  const double rest = 0.2 - (height_of(scene, 0.201) - height_of(scene, 0.001));
  EXPECT_NEAR(rest, expected, 0.01 * expected);
  EXPECT_GE(lowest(scene), 0.001);
  EXPECT_LT(lowest(scene), 0.001 + 1e-6);
  EXPECT_LT(scene->momentum().norm(), 1e-4);
}
INSTANTIATE_TEST_SUITE_P(SolvedContact, StepOf, testing::Values(1e-3, 3e-3, 1e-2, 3e-2));

// The same as an equilibrium, which nothing but the floor and its friction hold in place.
TEST(SolvedContact, static_solves_rest_on_the_floor) {
  const Loaded scene = load(block(0.1, floor_below, 0.5, 0, "", "static"));
  run(scene, 0.2);
  const double expected = 10 * 9.81 / (0.4 * 0.4) * 0.2 / (2 * 1e5);
  const double rest = 0.2 - (height_of(scene, 0.201) - height_of(scene, 0.001));
  EXPECT_NEAR(rest, expected, 0.01 * expected);
  EXPECT_GE(lowest(scene), 0.001);
  EXPECT_LT(lowest(scene), 0.001 + 1e-6);
}

// A sphere that sinks into it slowly: as far as implicit steps with viscosity come in the same time.
TEST(SolvedContact, static_and_implicit_agree_on_a_sphere_that_is_pressed_in) {
  const std::string world =
      R"(<world><floor z="0"/><sphere centre="0.2 0.2 0.3021" radius="0.1" velocity="0 0 -0.02"/></world>)";
  const Loaded still = load(block(0.1, world, 0, 0, R"(<fix side="-z"/>)", "static"));
  const Loaded moving =
      load(block(0.01, world, 0, 0, R"(<fix side="-z"/><viscosity value="100" per="body"/>)"));
  run(still, 1);
  run(moving, 1);
  const std::vector<Record>&a = still.body().map->position().values(),
        &b = moving.body().map->position().values();
  double largest = 0, moved = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, (a[i].vec() - b[i].vec()).norm());
    moved = std::max(moved, (a[i].vec() - still.body().map->rest().values()[i].vec()).norm());
  }
  EXPECT_GT(moved, 0.01);
  EXPECT_LT(largest, 0.02 * moved);
}

// Gravity turned by atan 0.495: μ = 0.5 holds, and 0.49 slides with g (sin θ − μ cos θ).
TEST(SolvedContact, a_block_stands_on_a_slope_or_slides_by_coulombs_law) {
  const double angle = std::atan(0.495), g = 9.81;
  const std::string slope = fmt::format(R"(<world gravity="{:.17g} 0 {:.17g}"><floor z="0"/></world>)",
                                        g * std::sin(angle), -g * std::cos(angle));
  const auto middle = [](const Loaded& scene) { // [m], along the slope
    double sum = 0;
    for (const Record& x : scene.body().map->position().values()) sum += x.x;
    return sum / static_cast<double>(scene.body().vertices());
  };
  const Loaded stands = load(block(5e-3, slope, 0.5)), slides = load(block(5e-3, slope, 0.49));
  run(stands, 1);
  const double before = middle(stands);
  run(stands, 5);
  EXPECT_LT(std::abs(middle(stands) - before), 1e-4);
  run(slides, 1);
  const double start = slides->momentum().x() / 10;
  run(slides, 3);
  const double expected = g * (std::sin(angle) - 0.49 * std::cos(angle));
  EXPECT_NEAR((slides->momentum().x() / 10 - start) / 2, expected, 0.02 * expected);
}

// What falls on the floor and on the edge of a box with large steps stays outside, and gains nothing.
TEST(SolvedContact, fast_bodies_stop_at_floor_and_box_with_large_steps) {
  const Loaded scene = load(block(3e-2, R"(<world><floor z="0"/><box low="0.3 -1 0" high="1 1 0.1"/></world>)",
                                  0.3, 1, R"(<viscosity value="1" per="body"/>)"));
  double most = 0;
  while (scene->time() < 3) {
    scene->step();
    for (const Record& x : scene.body().map->position().values()) {
      ASSERT_GE(x.z, 0.001 - 1e-9);
      ASSERT_FALSE(x.x > 0.3 && x.z < 0.1) << x.x << " " << x.z;
    }
    most = std::max(most, scene->kinetic_energy() + scene->elastic_energy());
  }
  EXPECT_LT(most, 1.01 * 10 * 9.81); // that of a fall of 1 m
}

// A sphere that keeps its velocity pushes a free body before it: the account tells its work.
TEST(SolvedContact, a_moving_sphere_does_work) {
  const Loaded scene = load(block(
      5e-3, R"(<world gravity="0 0 0"><sphere centre="-0.4 0.2 0.1" radius="0.2" velocity="1 0 0"/></world>)",
      0, 0));
  run(scene, 0.8);
  const EnergyFigures e = scene->energy();
  EXPECT_GT(scene->momentum().x(), 9);
  EXPECT_GT(e.now.work.contact.obstacles, 4.5); // at least the kinetic energy of 10 kg at 1 m/s, less round-off
  EXPECT_LT(e.gained, 1e-3 * e.scale);
}

// Friction carries a block along: with μ g until it has the velocity of what it stands on.
TEST(SolvedContact, a_moving_box_carries_what_stands_on_it) {
  const Loaded scene =
      load(block(5e-3, R"(<world><box low="-5 -1 -0.1" high="5 2 0" velocity="0.5 0 0"/></world>)", 0.2, 0));
  run(scene, 0.1);
  EXPECT_NEAR(scene->momentum().x(), 10 * 0.2 * 9.81 * 0.1, 0.05 * 10 * 0.2 * 9.81 * 0.1);
  run(scene, 1);
  EXPECT_NEAR(scene->momentum().x(), 5, 0.01);
  const EnergyFigures e = scene->energy();
  EXPECT_GT(e.now.work.contact.obstacles, 2.4); // ½ 10 0.5², and what friction took, which is the same again
  EXPECT_LT(e.gained, 1e-2 * e.scale);
}

// f = −∂P/∂x and the tangent = −∂f/∂x, by central differences, in contact and off it; with friction that sticks
// and that slides.
TEST(SolvedContact, forces_and_tangent_are_derivatives) {
  for (const double friction : {0.0, 0.4}) {
    const Loaded scene = load(block(1e-2, floor_below, friction));
    Body& body = scene.body();
    scene->step();
    const std::size_t count = body.vertices();
    const std::vector<Record> start = body.map->position().values();
    const std::vector<Record> still = body.map->velocity().values();
    body.evaluate();
    body.begin_solve(scene->time() + 1e-2, 1e-2, {start.data(), still.data()}, body.force.data());
    SolvedContact& contact = *body.solved_contact;
    std::vector<Record> x = start;
    for (std::size_t i = 0; i < count; ++i) {
      x[i].z += (i % 3 == 0 ? -1e-4 : 2e-6) * static_cast<double>(i % 5);
      x[i].x += (i % 2 == 0 ? 2e-9 : 1e-4);
      x[i].y += 1e-9 * static_cast<double>(i);
    }
    if (friction > 0) contact.tighten(x.data());
    const auto forces = [&](const std::vector<Record>& at) {
      std::vector<Record> f(count);
      contact.add_forces(at.data(), f.data());
      return f;
    };
    BlockMatrix K;
    K.reset(body.pattern());
    contact.add_stiffness(x.data(), 1, K);
    const std::vector<Record> at = forces(x);
    double largest = 0;
    for (std::size_t i = 0; i < count; ++i) {
      largest = std::max(largest, at[i].vec().norm());
      for (int c = 0; c < 3; ++c) {
        constexpr double h = 1e-11;
        std::vector<Record> above = x, below = x;
        (&above[i].x)[c] += h;
        (&below[i].x)[c] -= h;
        const double width = (&above[i].x)[c] - (&below[i].x)[c];
        const Vec3 slope = (forces(below)[i].vec() - forces(above)[i].vec()) / width;
        for (int r = 0; r < 3; ++r)
          EXPECT_NEAR(K.diagonal(i)(r, c), slope[r], 1e-3 * K.diagonal(i).matrix().norm() + 1e-3)
              << i << r << c;
        if (friction > 0) continue;
        const double change = contact.potential(below.data()) - contact.potential(above.data());
        EXPECT_NEAR((&at[i].x)[c], change / width, 1e-3 * at[i].vec().norm() + 2e-2) << i << c;
      }
    }
    EXPECT_GT(largest, 1);
  }
}

} // namespace
} // namespace rend::solved_contact_test
