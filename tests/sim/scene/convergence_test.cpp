// Orders of convergence of displacements, for every kind of element (tests/README.md, "Convergence";
// tests/bench/convergence goes further).
#include "sim/presets.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace rend::convergence_test {
namespace {

// The displacement of the body's first probe in static equilibrium [m].
Vec3 displacement(const std::string& in_body) {
  const auto s =
      presets::load("<scene><body>" + in_body + R"(<fix side="-x"/></body><world gravity="0 0 0"/>)" +
                    R"(<time step="1" integrator="static" duration="1"/></scene>)");
  s->step();
  return s.body().probes[0].read(s.body())->displacement;
}

double order(double answer, double coarse, double fine) {
  return std::log2((answer - coarse) / (answer - fine));
}

// P L³/(3 E I) + P L/(κ G A), κ = 5/6, without lateral strain: smooth, so the order is two.
TEST(Convergence, of_a_cantilever_is_of_order_two) {
  const auto tip = [](const char* pattern, int n) {
    return -displacement(fmt::format(R"(<bar pattern="{}" cells="{} 1 {}" size="1 0.05 0.1"/><mass total="1"/>
      <elasticity model="linear" young="1e7" poisson="0"/><load side="+x" force="0 0 -0.1"/>
      <probe name="tip" side="+x"/>)",
                                     pattern, 20 * n, 2 * n))
                .z();
  };
  for (const char* pattern : {"hexahedra", "prisms", "mixed", "tetrahedra"}) {
    const double observed = order(8.048e-4, tip(pattern, 2), tip(pattern, 4));
    EXPECT_GT(observed, 1.8) << pattern;
    EXPECT_LT(observed, 2.1) << pattern;
  }
}

// Cook's membrane is singular at its clamped corner: the order is below two. Quads are more exact than
// triangles throughout.
TEST(Convergence, of_cooks_membrane_is_from_below_and_quads_are_ahead) {
  const auto tip = [](const char* pattern, int n) {
    return displacement(
               fmt::format(R"(<sheet pattern="{}" cells="{} {}" corners="0 0 0 48 44 0 48 60 0 0 44 0"/>
      <mass total="1"/><elasticity model="linear" young="1" poisson="0.3333333333333333" thickness="1"/>
      <fix all="yes" axes="z"/><load side="+x" force="0 1 0"/><probe name="tip" near="48 52 0"/>)",
                           pattern, n, n))
        .y();
  };
  double quads = 0;
  for (const char* pattern : {"quads", "triangles"}) {
    const double coarse = tip(pattern, 16), fine = tip(pattern, 32), observed = order(23.967, coarse, fine);
    EXPECT_GT(observed, 1.7) << pattern;
    EXPECT_LT(observed, 2) << pattern;
    EXPECT_LT(fine, 23.967) << pattern;
    if (quads == 0) quads = fine;
    EXPECT_LE(fine, quads) << pattern;
  }
}

} // namespace
} // namespace rend::convergence_test
