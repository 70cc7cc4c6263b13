// Probes against averages and laws of motion: the reaction of a support balances the weight, the loads and the
// change of angular momentum.
#include "sim/body/probe.h"

#include "sim/base/math.h"
#include "sim/presets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace rend::probe_test {
namespace {

using testing::HasSubstr;

presets::Loaded cloth(const std::string& in_body, const std::string& more = "",
                      const std::string& scheme = "rk4") {
  return presets::load(R"(<scene><body><sheet pattern="mixed" cells="4 4" size="1 1"/>
    <place rotate="90 0 0"/><mass total="0.3"/>
    <springs><stretch k="60" damping="0.02"/><shear k="40"/></springs>)" +
                       in_body + "</body>" + more + R"(<time step="1e-3" duration="8" integrator=")" + scheme +
                       R"("/></scene>)");
}

ProbeReading reading(const presets::Loaded& scene, std::size_t probe = 0) {
  return *scene.body().probes[probe].read(scene.body());
}

TEST(Probe, tells_the_mean_of_its_vertices_however_they_are_split) {
  const auto scene = cloth(R"(<probe name="p" side="+x"/><drive all="yes" gradient="0.1 0 0 0 0 0 0 0 0.3"/>)");
  for (int round = 0; round < 2; ++round) {
    const ProbeReading r = reading(scene);
    EXPECT_NEAR((r.position - Vec3(1.1, 0, 0.65)).norm(), 0, 1e-15);
    EXPECT_NEAR((r.displacement - Vec3(0.1, 0, 0.15)).norm(), 0, 1e-15);
    scene.body().map->edit([](Edit& edit) {
      for (std::uint32_t d = 0; d < edit.map().capacity(); ++d) unsew(edit, 2, Dart{d});
    });
    scene.body().rebind();
  }
}

// At rest and in motion: the reaction follows from Newton's law.
TEST(Probe, finds_that_a_support_bears_the_weight_of_what_hangs_on_it) {
  const auto scene = cloth(R"(<viscosity value="2" per="body"/><fix side="+z"/><probe name="top" side="+z"/>
    <probe name="low" side="-z"/><load near="0.5 0 0" force="0.5 0 -1"/>)");
  for (int n = 0; n < 8000; ++n) scene->step();
  EXPECT_LT(scene->kinetic_energy(), 1e-12);
  EXPECT_NEAR((*reading(scene).reaction - Vec3(-0.5, 0, 0.3 * 9.81 + 1)).norm(), 0, 1e-5);
  EXPECT_FALSE(reading(scene, 1).reaction.has_value());
}

TEST(Probe, finds_the_force_that_a_turning_body_takes) {
  const auto scene = cloth(R"(<drive all="yes" rotate="0 1 0 90" centre="0 0 0"/><probe name="p" all="yes"/>)",
                           R"(<world gravity="0 0 0"/>)");
  for (int n = 0; n < 100; ++n) scene->step();
  const double rate = pi / 2;
  Vec3 centre = Vec3::Zero();
  centre = scene->momentum().cross(Vec3(0, 1, 0)) / rate; // Σ m r, since Σ m ω × r = Σ m v
  EXPECT_NEAR(centre.norm(), 0.3 * std::sqrt(0.5), 1e-12);
  EXPECT_NEAR((*reading(scene).reaction - rate * Vec3(0, 1, 0).cross(scene->momentum())).norm(), 0, 1e-11);
}

// The patch test of MacNeal & Harder (1985), plane stress: u = G X with E = 1e6 and ν = 0.25 gives σx = σy =
// 1333.3, τ = 400 [Pa].
TEST(Probe, tells_the_stress_of_the_elements_there) {
  for (const char* pattern : {"quads", "triangles", "mixed"}) {
    const auto scene = presets::load(R"(<scene><body><sheet pattern=")" + std::string(pattern) +
                                     R"(" cells="3 2" size="0.24 0.12"/><mass total="1"/>
      <elasticity model="linear" young="1e6" poisson="0.25" thickness="0.001"/><fix all="yes" axes="z"/>
      <drive all="yes" axes="xy" gradient="1e-3 5e-4 0 5e-4 1e-3 0 0 0 0"/>
      <probe name="one" near="0.08 0.06 0"/><probe name="all" all="yes"/></body>
      <time step="1e-4" duration="1"/></scene>)");
    for (std::size_t probe = 0; probe < 2; ++probe) {
      const ProbeReading r = reading(scene, probe);
      EXPECT_NEAR(quantity_of(r, "stress-xx"), 4000.0 / 3, 1e-8) << pattern;
      EXPECT_NEAR(quantity_of(r, "stress-yy"), 4000.0 / 3, 1e-8) << pattern;
      EXPECT_NEAR(quantity_of(r, "stress-xy"), 400, 1e-8) << pattern;
      EXPECT_NEAR(quantity_of(r, "stress-zz"), 0, 1e-8) << pattern;
    }
  }
  EXPECT_FALSE(reading(cloth(R"(<probe name="p" all="yes"/>)")).stress.has_value());
}

TEST(Probe, looks_along_the_axes_that_are_held_alone) {
  const auto scene =
      cloth(R"(<fix all="yes" axes="z"/><probe name="p" all="yes"/><load side="+x" force="1 0 0"/>)");
  scene->step();
  EXPECT_NEAR(reading(scene).reaction->z(), 0.3 * 9.81, 1e-9);
  EXPECT_EQ(reading(scene).reaction->x(), 0);
}

TEST(Probe, changes_nothing) {
  const std::string in_body = R"(<fix side="+z"/><load side="-z" force="0 0 -1" follows="body"/>)";
  const auto plain = cloth(in_body), probed = cloth(in_body + R"(<probe name="top" side="+z"/>)");
  for (int n = 0; n < 50; ++n) {
    plain->step();
    probed->step();
    reading(probed);
  }
  EXPECT_EQ(plain->hash(), probed->hash());
}

TEST(Answer, is_measured_at_its_time) {
  const auto scene = presets::load(R"(<scene><body><sheet cells="1 1" size="1 1"/><mass total="1"/>
    <probe name="p" all="yes"/>
    <answer probe="p" quantity="dz" at="0" value="0" tolerance="0"/>
    <answer probe="p" quantity="dz" at="0.3" value="-0.44145" tolerance="1e-12"/>
    <answer probe="p" quantity="d" value="19.62" tolerance="1e-12"/>
    <answer probe="p" quantity="x" at="0.4" value="0.6" tolerance="0.1"/></body>
    <time step="0.1" duration="2" integrator="verlet"/></scene>)");
  const std::vector<Answer>& answers = scene.body().answers;
  EXPECT_EQ(answers[0].measured, 0);
  EXPECT_TRUE(answers[0].holds());
  EXPECT_FALSE(answers[1].asked);
  for (int n = 0; n < 3; ++n) scene->step();
  EXPECT_TRUE(answers[1].holds()) << answers[1].error();
  EXPECT_FALSE(answers[2].asked);
  for (int n = 0; n < 20; ++n) scene->step(); // beyond the end
  EXPECT_TRUE(answers[2].holds()) << answers[2].error();
  EXPECT_TRUE(answers[3].asked);
  EXPECT_FALSE(answers[3].holds());
  EXPECT_NEAR(answers[3].error(), -1.0 / 6, 1e-15);
}

TEST(Answer, after_the_end_is_never_asked_for_and_that_is_said) {
  const auto scene = cloth(R"(<probe name="p" side="+x"/><answer probe="p" quantity="x" value="1" at="9"/>)");
  ASSERT_EQ(scene->notes().size(), 1u);
  EXPECT_THAT(scene->notes().front(), HasSubstr("before the time of this answer, 9 s"));
}

std::string refusal_of(const std::string& in_body) {
  try {
    cloth(in_body);
  } catch (const UserError& error) {
    return std::string(error.what()) + " | " + error.hint;
  }
  return "not refused";
}

TEST(Answer, is_refused_where_nothing_can_be_measured) {
  const std::string probe = R"(<probe name="tip" side="+x"/>)";
  EXPECT_THAT(refusal_of(probe + probe), HasSubstr("two probes are called 'tip'"));
  EXPECT_THAT(refusal_of(R"(<probe name="a b" side="+x"/>)"), HasSubstr("holds ' '"));
  EXPECT_THAT(refusal_of(probe + R"(<answer probe="top" quantity="x" value="1"/>)"), HasSubstr("'tip'"));
  EXPECT_THAT(refusal_of(probe + R"(<answer probe="tip" quantity="reaction-x" value="1"/>)"),
              HasSubstr("neither fixed nor driven"));
}

} // namespace
} // namespace rend::probe_test
