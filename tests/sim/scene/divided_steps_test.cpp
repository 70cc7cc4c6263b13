// A step that was chosen for the elements at the start is divided where a law makes elements that need smaller
// ones.
#include "sim/presets.h"
#include "sim/rows/vertex_bounds.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace rend::divided_steps_test {
namespace {

// A stretched sheet of quads, whose law divides each face into triangles from its middle until that time [s].
presets::Loaded starred(const std::string& step, double until) {
  return presets::load(fmt::format(
      R"(<scene><body><sheet pattern="quads" cells="6 4" size="0.6 0.4"/><mass density="1000" thickness="1e-3"/>
         <elasticity young="2e5" thickness="1e-3"/><drive side="-x" velocity="-0.3 0 0"/>
         <drive side="+x" velocity="0.3 0 0"/>
         <tear criterion="strain" threshold="1e-5" rule="star-face" until="{}"/></body>
         <world gravity="0 0 0"/><time step="{}" integrator="verlet" duration="1"/></scene>)",
      until, step));
}

constexpr int divisions = 3; // steps with the law: each makes 4 triangles of a quad, 3 of a triangle

TEST(DividedSteps, are_stable_for_the_elements_that_laws_have_made) {
  const double step = starred("auto", 0)->step_size();
  const auto scene = starred("auto", (divisions - 0.5) * step);
  ASSERT_EQ(scene->step_size(), step);
  EXPECT_GT(scene->stability_limit(scene->scheme()), step);
  for (int n = 0; n < 200; ++n) scene->step();
  EXPECT_GT(scene->tears(), 24u);
  EXPECT_LT(scene->stability_limit(scene->scheme()), step);
  const Body& body = scene.body();
  const FrequencyBounds found = VertexBounds(*body.map, body.interactions, *body.mass, body.drag).bounds();
  const double limit = scene->scheme().limit({found.omega_squared, found.damping_rate, found.least_drag_rate});
  const int parts = scene->guard().most_substeps;
  EXPECT_LE(step / parts, limit);
  EXPECT_GT(step / (parts - 1), limit); // no more than are needed
  EXPECT_EQ(scene->guard().rejected, 0);
}

// Where something touches, rk45 makes steps of velocity Verlet, which has no account of its error.
TEST(DividedSteps, are_stable_where_an_adaptive_scheme_has_contact) {
  const auto scene = presets::load(R"(<scene><body><sheet pattern="triangles" cells="16 16" size="1 1"/>
      <place translate="-0.5 -0.5 0.3"/><mass density="1000" thickness="1e-3"/>
      <elasticity model="corotational" young="1e6" poisson="0.3" thickness="1e-3" damping-mass="2"/>
      <fix side="-x"/><drive side="+x" velocity="1 0 0.2"/>
      <tear criterion="vertex-stress" threshold="1e5" change="cut"/>
      <contact with="obstacles fragments" thickness="0.006" friction="0.4"/></body>
      <world gravity="0 0 -9.81"><floor z="0"/></world>
      <time step="auto" integrator="rk45" duration="0.2"/></scene>)");
  while (scene->time() < 0.2) scene->step();
  EXPECT_GT(scene->tears(), 10u);
  EXPECT_GT(scene->guard().most_substeps, 1);
  EXPECT_LT(scene->energy().now.kinetic, 5); // [J], of 1 kg that is pulled at 1 m/s
}

// Steps need no division where what laws make allows them.
TEST(DividedSteps, are_none_where_laws_make_nothing_smaller) {
  const auto scene = presets::load(R"(<scene><body><sheet pattern="quads" cells="6 4" size="0.6 0.4"/>
      <mass density="1000" thickness="1e-3"/><elasticity young="2e5" thickness="1e-3"/>
      <drive side="-x" velocity="-0.3 0 0"/><drive side="+x" velocity="0.3 0 0"/>
      <tear criterion="strain" threshold="1e-3" rule="unsew-edge"/></body>
      <world gravity="0 0 0"/><time step="auto" integrator="verlet" duration="1"/></scene>)");
  for (int n = 0; n < 1000 && scene->tears() == 0; ++n) scene->step();
  EXPECT_GT(scene->tears(), 0u);
  EXPECT_EQ(scene->guard().most_substeps, 1);
}

} // namespace
} // namespace rend::divided_steps_test
