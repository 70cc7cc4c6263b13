#include "sim/outside/injected_fault.h"

#include "tests/sim/presets.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rend::injected_fault_test {
namespace {

constexpr StepStage struck_stages[] = {StepStage::Forces, StepStage::Loads, StepStage::Integration,
                                       StepStage::Contact};

presets::Loaded loaded(const SceneOptions& options) {
  return presets::load(presets::cloth("quads", 5, "",
                                      R"(<time step="1e-3" integrator="symplectic" duration="1"/>)", "",
                                      R"(<load side="-x" force="0 0.1 0"/>)"),
                       options);
}

// Without the guard, a fault stops the run, with the state before it intact.
TEST(Faults, spoil_the_step_and_the_stage_that_they_name) {
  for (const StepStage stage : struck_stages) {
    SceneOptions options;
    options.guard = false;
    options.fault = Fault{stage, 7, false};
    const presets::Loaded scene = loaded(options);
    for (int n = 0; n < 7; ++n) scene->step();
    const std::uint64_t before = scene->hash();
    EXPECT_THROW(scene->step(), Unstable) << name_of(stage);
    EXPECT_EQ(scene->hash(), before) << name_of(stage);
    EXPECT_EQ(scene->steps_done(), 7) << name_of(stage);
  }
}

TEST(Faults, happen_once_unless_they_last) {
  for (const StepStage stage : struck_stages) {
    SceneOptions options;
    options.guard = false;
    options.fault = Fault{stage, 2, false};
    const presets::Loaded once = loaded(options), never = loaded({});
    options.fault->lasting = true;
    const presets::Loaded lasting = loaded(options);
    for (int n = 0; n < 2; ++n) {
      once->step();
      lasting->step();
    }
    EXPECT_THROW(once->step(), Unstable);
    for (int tries = 0; tries < 3; ++tries) EXPECT_THROW(lasting->step(), Unstable) << name_of(stage);
    for (int n = 2; n < 20; ++n) once->step(); // again, and further
    for (int n = 0; n < 20; ++n) never->step();
    EXPECT_EQ(once->hash(), never->hash()) << name_of(stage);
  }
}

TEST(Scene, counts_evaluations_of_the_internal_forces) {
  const auto count = [](const std::string& scheme) {
    const auto scene = presets::load(presets::cloth(
        "quads", 5, "", R"(<time step="1e-3" duration="1" integrator=")" + scheme + R"("/>)", ""));
    for (int n = 0; n < 10; ++n) scene->step();
    scene->kinetic_energy();
    return scene->evaluations();
  };
  EXPECT_EQ(count("symplectic"), 10);
  EXPECT_EQ(count("verlet"), 20);
  EXPECT_EQ(count("rk4"), 40);
  EXPECT_GE(count("implicit"), 20);
}

} // namespace
} // namespace rend::injected_fault_test
