#include "sim/build/build_scene.h"
#include "sim/check/step_limit.h"

#include "render/picture/scene_preset.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace rend::step_limit_test {
namespace {

const Scheme& scheme(const char* name) {
  return *find_scheme(name);
}

// The closed forms of stable steps (tests/README.md, "Closed forms") follow numerically from the schemes.
TEST(StepLimitOfMode, IsTheFormulaWhereThereIsOne) {
  for (const double omega : {0.5, 40.0, 3e5}) {
    const double w2 = omega * omega;
    EXPECT_NEAR(step_limit_of_mode(scheme("symplectic"), w2, 0) * omega, 2, 1e-5);
    EXPECT_NEAR(step_limit_of_mode(scheme("verlet"), w2, 0) * omega, 2, 1e-5);
    EXPECT_NEAR(step_limit_of_mode(scheme("rk4"), w2, 0) * omega, 2 * std::sqrt(2.0), 1e-5);
    EXPECT_EQ(step_limit_of_mode(scheme("explicit"), w2, 0), 0);
    EXPECT_EQ(step_limit_of_mode(scheme("midpoint"), w2, 0), 0);
    for (const double xi : {0.05, 0.3, 0.9}) {
      const double d = xi * omega; // the rate is 2 d
      EXPECT_NEAR(step_limit_of_mode(scheme("symplectic"), w2, 2 * d), 2 / (std::sqrt(w2 + d * d) + d),
                  1e-6 / omega);
      EXPECT_NEAR(step_limit_of_mode(scheme("explicit"), w2, 2 * d), 2 * xi / omega, 1e-6 / omega);
    }
    EXPECT_NEAR(step_limit_of_mode(scheme("rk4"), w2, omega) * omega, 2.62, 0.005); // ξ = 0.5
  }
}

TEST(StepLimitOfMode, IsInfiniteWhereEveryStepIsStable) {
  EXPECT_TRUE(std::isinf(step_limit_of_mode(scheme("implicit"), 100, 1)));
  EXPECT_TRUE(std::isinf(step_limit_of_mode(scheme("symplectic"), 0, 0)));
}

struct Built {
  std::unique_ptr<PresetNode> preset;
  std::unique_ptr<Scene> scene;
};
Built built(const std::string& matter, const std::string& integrator) {
  const std::string text = fmt::format(R"(<scene name="b"><body name="b"><bar pattern="tetrahedra" cells="2 1 1"
    size="1 0.4 0.5"/><mass density="10"/>{}</body><world gravity="0 0 0"/>
    <time step="1e-4" integrator="{}" duration="1"/></scene>)",
                                       matter, integrator);
  Built b;
  b.preset = load_scene_text(text, "b.xml");
  b.scene = std::make_unique<Scene>(read_scene(*b.preset), SceneOptions{});
  return b;
}

// With Rayleigh damping the modes are decoupled, and the fastest one determines the step. The body is free:
// rigid motions must not be taken for growth.
TEST(StepLimit, OfABodyIsThatOfItsFastestModeUnderProportionalDamping) {
  for (const char* name : {"symplectic", "verlet", "rk4"})
    for (const char* more : {"", " damping-mass=\"3\"", " damping-mass=\"3\" damping-stiffness=\"2e-3\""}) {
      const Built b = built(fmt::format("<elasticity model=\"corotational\" young=\"1e4\"{}/>", more), name);
      Linearised linear(*b.scene->bodies()[0], 0);
      const StepLimit limit = step_limit(scheme(name), linear);
      EXPECT_NEAR(limit.step, limit.of_mode, 1e-3 * limit.of_mode) << name << more;
      EXPECT_LT(b.scene->step_size(), limit.step);
    }
}

// Equal damping of each particle: light ones are damped most, and modes are coupled. There is no closed form;
// the scheme's amplification matrix is used.
TEST(StepLimit, SeesWhatDampingCouples) {
  const Built b =
      built("<elasticity model=\"corotational\" young=\"1e4\"/><viscosity value=\"30\"/>", "verlet");
  Linearised linear(*b.scene->bodies()[0], 0);
  const StepLimit limit = step_limit(scheme("verlet"), linear);
  EXPECT_LT(limit.step, 0.98 * limit.of_mode);
}

} // namespace
} // namespace rend::step_limit_test
