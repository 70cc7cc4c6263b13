// Initial velocities and ramps, against closed forms of free flight.
#include "sim/base/math.h"
#include "sim/presets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rend::start_motion_test {
namespace {

using testing::HasSubstr;

std::string cube(const std::string& place, const std::string& more = "") {
  return R"(<body name="a"><bar cells="1 1 1" size="0.2 0.2 0.2"/><place )" + place +
         R"(/><mass total="8"/><elasticity model="corotational" young="1e4" poisson="0.3"/>)" + more +
         "</body>";
}

presets::Loaded loaded(const std::string& body, const std::string& world, const std::string& time) {
  return presets::load("<scene>" + body + world + "<time " + time + "/></scene>");
}

const std::string weightless = R"(<world gravity="0 0 0"/>)";

Vec3 centre(const Body& body) {
  Vec3 sum = Vec3::Zero();
  for (const Record& x : body.map->position().values()) sum += x.vec() / 8;
  return sum;
}

TEST(StartMotion, a_body_flies_as_it_was_thrown) {
  const auto s = loaded(cube(R"(translate="1 2 3" velocity="1 -2 0.5")"), R"(<world gravity="0 0 -10"/>)",
                        R"(step="1e-3" integrator="verlet" duration="1")");
  EXPECT_LT((s->momentum() - 8 * Vec3(1, -2, 0.5)).norm(), 1e-12);
  for (int n = 0; n < 500; ++n) s->step();
  EXPECT_LT((centre(s.body()) - Vec3(1.1 + 0.5, 2.1 - 1, 3.1 + 0.25 - 0.5 * 10 * 0.25)).norm(), 1e-10);
  EXPECT_LT(s->elastic_energy(), 1e-18) << "all vertices started alike";
}

// Eight masses of 1 kg at the corners: I = 8 · (0.1² + 0.1²) about every axis through the middle.
TEST(StartMotion, a_body_spins_about_its_centre_of_mass_in_axes_of_the_world) {
  for (const char* place : {R"(translate="1 2 3" spin="0 0 180")", R"(rotate="30 0 45" spin="90 180 45")"}) {
    const auto s = loaded(cube(place), weightless, R"(step="1e-4" duration="1")");
    const Vec3 spin =
        pi / 180 *
        (std::string(place).find("45\" spin") == std::string::npos ? Vec3(0, 0, 180) : Vec3(90, 180, 45));
    EXPECT_LT(s->momentum().norm(), 1e-13);
    EXPECT_LT((s->angular_momentum() - 0.16 * spin).norm(), 1e-13);
    EXPECT_NEAR(s->kinetic_energy(), 0.5 * 0.16 * spin.squaredNorm(), 1e-12);
    const Vec3 at = centre(s.body());
    for (int n = 0; n < 1000; ++n) s->step();
    EXPECT_LT((centre(s.body()) - at).norm(), 1e-12);
    EXPECT_LT(s->momentum().norm(), 1e-12);
  }
}

TEST(StartMotion, what_is_prescribed_starts_as_it_says) {
  const auto s = loaded(cube(R"(velocity="1 0 0" spin="0 90 0")", R"(<fix side="-x"/>)"), weightless,
                        R"(step="1e-4" duration="1")");
  int fixed = 0, thrown = 0;
  for (Slot v = 0; v < 8; ++v) {
    const bool held = s.body().map->rest()[v].x == 0;
    ++(held ? fixed : thrown);
    EXPECT_EQ(s.body().map->velocity()[v].vec().norm() == 0, held);
  }
  EXPECT_EQ(fixed, 4);
  EXPECT_EQ(thrown, 4);
}

// A linear ramp of length T: the momentum is m g T/2 after it, the way g T²/6; Runge and Kutta's scheme of
// order 4 is exact for both.
TEST(Ramp, of_gravity_gives_half_the_momentum_of_its_length) {
  const auto s = loaded(cube(""), R"(<world gravity="0 0 -10" over="0.5"/>)",
                        R"(step="1e-3" integrator="rk4" duration="1")");
  const Vec3 at = centre(s.body());
  double work = 0; // of what acts, by the trapezoidal rule
  for (int n = 0; n < 500; ++n) {
    const double before = s->momentum().z(), share = s->time() / 0.5;
    s->step();
    work += 0.5 * 1e-3 * (before * share + s->momentum().z() * (share + 1e-3 / 0.5)) * -10;
  }
  EXPECT_NEAR(s->momentum().z(), -8 * 10 * 0.5 / 2, 1e-10);
  EXPECT_NEAR(centre(s.body()).z() - at.z(), -10 * 0.25 / 6, 1e-12);
  EXPECT_NEAR(s->kinetic_energy(), work, 1e-4 * work);
  for (int n = 0; n < 500; ++n) s->step();
  EXPECT_NEAR(s->momentum().z(), -8 * 10 * (0.25 + 0.5), 1e-10);
}

TEST(Ramp, of_gravity_holds_for_all_schemes_and_for_spheres) {
  for (const char* scheme :
       {"symplectic", "explicit", "verlet", "midpoint", "rk45", "implicit", "tr-bdf2", "alpha"}) {
    const auto s = loaded(
        cube(""), R"(<world gravity="0 0 -10" over="0.5"><sphere centre="9 9 9" radius="1" mass="2"/></world>)",
        std::string(R"(step="1e-3" duration="1" integrator=")") + scheme + "\"");
    while (s->time() < 0.4995) s->step();
    // the sum over steps of order 1 is off by half a step
    EXPECT_NEAR(total_momentum(*s.body().map, *s.body().mass).z(), -20, 8 * 10 * 0.5e-3 * 1.01) << scheme;
    EXPECT_NEAR(s->world().spheres[0].velocity.z(), -2.5, 10 * 0.5e-3 * 1.01) << scheme;
  }
}

// Gravity that grows against the motion does less work than whole gravity: the guard must not take the
// difference for energy from nowhere.
TEST(Ramp, of_gravity_is_no_trouble_for_the_guard) {
  const auto s = loaded(cube(R"(velocity="0 0 20")"), R"(<world gravity="0 0 -100" over="1"/>)",
                        R"(step="1e-3" duration="1")");
  while (s->time() < 0.999) s->step();
  EXPECT_EQ(s->guard().rejected, 0);
}

TEST(Ramp, of_a_load_gives_half_the_impulse_of_its_length) {
  const auto s = loaded(cube("", R"(<load all="yes" force="4 0 0" over="0.5"/>)"), weightless,
                        R"(step="1e-3" integrator="rk4" duration="1")");
  for (int n = 0; n < 500; ++n) s->step();
  EXPECT_NEAR(s->momentum().x(), 0.5 * 4 * 0.5, 1e-12);
  EXPECT_NEAR(centre(s.body()).x() - 0.1, 4.0 / 8 * 0.25 / 6, 1e-10);
}

TEST(Ramp, over_is_until_by_its_length) {
  const std::string time = R"(step="1e-3" duration="1")";
  const auto one =
      loaded(cube("", R"(<load side="+x" force="4 0 0" from="0.25" until="0.75"/>)"), weightless, time);
  const auto other =
      loaded(cube("", R"(<load side="+x" force="4 0 0" from="0.25" over="0.5"/>)"), weightless, time);
  for (int n = 0; n < 800; ++n) {
    one->step();
    other->step();
  }
  EXPECT_EQ(one->hash(), other->hash());
  EXPECT_THROW(loaded(cube("", R"(<load side="+x" force="4 0 0" until="1" over="0.5"/>)"), weightless, time),
               UserError);
}

} // namespace
} // namespace rend::start_motion_test
