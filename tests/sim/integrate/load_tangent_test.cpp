// Loads that depend on the state (follower loads), in implicit schemes and static solves.
#include "sim/scene/scene.h"

#include "sim/presets.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace rend::load_tangent_test {
namespace {

constexpr double pi = 3.14159265358979323846;

// A strip of length 1 bent by a moment M with M L/EI = t is a circular arc; its end is at (sin t/t, (1 − cos
// t)/t).
TEST(StaticSolve, bends_a_strip_by_a_moment_along_a_circle_in_few_iterations) {
  const double thick = 0.05, stiffness = 1e7 * 0.05 * thick * thick * thick / 12; // [m], EI [N·m²]
  const auto s = presets::load(fmt::format(
      R"(<scene><body><bar pattern="hexahedra" cells="130 1 1" size="1 0.05 {}"/><mass density="1000"/>)"
      R"(<elasticity model="corotational" young="1e7" poisson="0"/><fix side="-x"/>)"
      R"(<load side="+x" moment="0 {} 0" follows="body" until="4"/><probe name="end" side="+x"/></body>)"
      R"(<world gravity="0 0 0"/><time step="1" integrator="static" duration="4"/></scene>)",
      thick, -pi * stiffness));
  for (int n = 1; n <= 4; ++n) {
    s->step();
    const double t = pi * n / 4;
    const ProbeReading end = s.body().probes.front().read(s.body()).value();
    EXPECT_NEAR(quantity_of(end, "dx"), std::sin(t) / t - 1, 0.01) << n;
    EXPECT_NEAR(quantity_of(end, "dz"), (1 - std::cos(t)) / t, 0.01) << n;
  }
  EXPECT_LT(s.body().integrator->solver().newton, 4 * 15);
}

// Two parallel chains of n links, connected to each other and held at both ends, under pressure: the corners
// lie on a circle of radius R and span an angle of 2φ. With a link's angle α = 2φ/n, the tension of a chain of
// half the width w is
//
//   T = p w/2 · R cos α/2 = k (2R sin α/2 − L/n),     R = L / (2 sin φ)
TEST(StaticSolve, blows_a_chain_up_to_an_arc) {
  const int links = 24;
  const double width = 0.2, k = 300, p = 60; // [m], [N/m], [Pa]
  const auto s = presets::load(fmt::format(
      R"(<scene><body><sheet cells="{} 1" size="1 {}"/><mass total="1"/><springs><stretch k="{}"/></springs>)"
      R"(<load all="yes" pressure="{}"/><fix side="-x"/><fix side="+x"/></body><world gravity="0 0 0"/>)"
      R"(<time step="1" integrator="static" duration="1"/></scene>)",
      links, width, k, p));
  s->step();
  double low = 1e-6, high = pi / 2;
  const auto surplus = [&](double phi) { // tension of the springs minus that required by the pressure
    const double radius = 0.5 / std::sin(phi), half = phi / links;
    return k * (2 * radius * std::sin(half) - 1.0 / links) - p * width / 2 * radius * std::cos(half);
  };
  for (int n = 0; n < 60; ++n) (surplus((low + high) / 2) > 0 ? high : low) = (low + high) / 2;
  const double radius = 0.5 / std::sin(low), depth = radius * std::cos(low);
  EXPECT_GT(low, 0.3); // far from flat
  for (const Record& x : s.body().map->position().values())
    EXPECT_NEAR(std::hypot(x.x - 0.5, x.z - depth), radius, 1e-7);
}

// A cloth under all of these loads: implicit Euler converges to the result of RK4 with small steps, with half
// the error at half the step.
TEST(ImplicitEuler, goes_where_rk4_goes_under_loads_that_follow) {
  const auto end_of = [](const char* scheme, double step) {
    const auto s = presets::load(fmt::format(
        R"(<scene><body><sheet cells="6 3" size="1 0.5"/><mass total="0.2"/>)"
        R"(<springs><stretch k="60"/><shear kind="isotropic" k="30"/><bend kind="provot" k="20"/></springs>)"
        R"(<viscosity value="0.4" per="body"/><fix side="-x"/><load all="yes" pressure="4"/>)"
        R"(<load side="+x" force="0 0.5 0.3" follows="body"/>)"
        R"(<load box="0.8 -1 -1 2 2 1" moment="0 0.05 0.05" follows="body"/></body>)"
        R"(<world gravity="0 0 -9.81"><wind velocity="1 4 2" drag="0.6"/></world>)"
        R"(<time step="{}" integrator="{}" duration="1"/></scene>)",
        step, scheme));
    for (int n = 0; n < static_cast<int>(std::lround(0.2 / step)); ++n) s->step();
    if (std::string(scheme) == "implicit") {
      EXPECT_LE(s.body().integrator->solver().newton, 6 * std::lround(0.2 / step)) << step;
    }
    std::vector<Vec3> x;
    for (const Record& r : s.body().map->position().values()) x.push_back(r.vec());
    return x;
  };
  const auto exact = end_of("rk4", 5e-4), rough = end_of("implicit", 1e-3), fine = end_of("implicit", 5e-4);
  double far = 0, near = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    far = std::max(far, (rough[i] - exact[i]).norm());
    near = std::max(near, (fine[i] - exact[i]).norm());
  }
  EXPECT_LT(near, 0.01);
  EXPECT_NEAR(far / near, 2, 0.3);
}

} // namespace
} // namespace rend::load_tangent_test
