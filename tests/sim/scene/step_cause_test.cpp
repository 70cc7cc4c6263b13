// What limits the step, and the gain that is promised for a change: against the step of the scene that has it.
#include "sim/scene/step_cause.h"

#include "sim/mesh/mesh_files.h"
#include "sim/presets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace rend::step_cause_test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using Of = StepCause::Of;

std::string scene_of(const std::string& bodies,
                     const std::string& time = R"(step="auto" integrator="symplectic")") {
  return "<scene>" + bodies + "<time duration=\"1\" " + time + "/></scene>";
}
std::string bar(const std::string& damping, const std::string& name = "ring") {
  return "<body name=\"" + name + R"("><bar pattern="tetrahedra" cells="4 2 2" size="0.4 0.2 0.2"/>
    <mass density="1000"/><elasticity model="corotational" young="1e6" poisson="0.3")" +
         damping + "/></body>";
}
std::string sheet(const std::string& springs, const std::string& more = "") {
  return R"(<body name="cloth"><sheet cells="8 8" size="1 1"/><mass total="0.1"/><springs>)" + springs +
         "</springs>" + more + "</body>";
}

struct Asked {
  StepCause cause;
  double limit; // [s], of the scene
};
Asked ask(const std::string& xml) {
  const auto scene = presets::load(xml);
  return {cause_of_step(*scene.scene), scene->stability_limit(scene->scheme())};
}

// The number after "with" in the words of a cause, and the gain that they promise.
struct Promise {
  std::string value;
  double gain = 0;
};
Promise promise_of(const std::string& words) {
  const std::string before_value = "with ", before_gain = " it is ";
  const std::size_t value = words.find(before_value), gain = words.find(before_gain, value);
  if (value == std::string::npos || gain == std::string::npos) return {};
  const std::size_t digits = value + before_value.size();
  return {words.substr(digits, words.find_first_not_of("-+.e0123456789", digits) - digits),
          std::stod(words.substr(gain + before_gain.size()))};
}

TEST(StepCause, is_the_damping_of_elements_and_a_lower_one_gives_the_step_it_promises) {
  const Asked damped = ask(scene_of(bar(R"( damping-stiffness="0.02")"))), free = ask(scene_of(bar("")));
  const double omega = 2 / free.limit, d = 0.02 * omega * omega / 2; // 2/(√(ω²+d²)+d), alone
  EXPECT_NEAR(damped.limit, 2 / (std::sqrt(omega * omega + d * d) + d), 1e-9 * damped.limit);
  EXPECT_EQ(damped.cause.of, Of::Damping);
  EXPECT_EQ(damped.cause.limit, damped.limit);
  EXPECT_THAT(damped.cause.words,
              HasSubstr("body 'ring': `damping-stiffness` of 0.02 s limits the step; with "));
  const Promise promise = promise_of(damped.cause.words);
  ASSERT_GT(promise.gain, 2) << damped.cause.words;
  const Asked lower = ask(scene_of(bar(" damping-stiffness=\"" + promise.value + "\"")));
  EXPECT_NEAR(lower.limit / damped.limit, promise.gain, 0.05 * promise.gain);
  EXPECT_NEAR(lower.limit / damped.limit, damped.cause.gain, 1e-9 * promise.gain);
  EXPECT_GE(lower.limit, 0.8 * free.limit);
}

TEST(StepCause, is_the_damping_of_the_springs_that_damp_most) {
  const auto springs = [](const std::string& damping) {
    return sheet(R"(<stretch k="60" damping=")" + damping +
                 R"("/><shear kind="isotropic" k="43" damping="1e-4"/>)");
  };
  const Asked damped = ask(scene_of(springs("0.5")));
  EXPECT_EQ(damped.cause.of, Of::Damping);
  EXPECT_THAT(damped.cause.words, HasSubstr("`damping` of the springs 'stretch' of 0.5 N s/m limits"));
  const Promise promise = promise_of(damped.cause.words);
  ASSERT_GT(promise.gain, 2) << damped.cause.words;
  EXPECT_NEAR(ask(scene_of(springs(promise.value))).limit / damped.limit, promise.gain, 0.05 * promise.gain);
}

TEST(StepCause, is_drag) {
  const std::string springs = R"(<stretch k="60"/>)";
  for (const char* viscosity :
       {R"(<viscosity value="500" per="body"/>)", R"(<viscosity value="5" per="particle"/>)"}) {
    const Asked dragged = ask(scene_of(sheet(springs, viscosity)));
    EXPECT_EQ(dragged.cause.of, Of::Drag) << dragged.cause.words;
    EXPECT_NEAR(ask(scene_of(sheet(springs))).limit / dragged.limit, dragged.cause.gain,
                1e-9 * dragged.cause.gain);
  }
}

TEST(StepCause, is_the_scheme_where_another_would_do) {
  const std::string cloth = sheet(R"(<stretch k="60"/>)", R"(<viscosity value="0.1" per="body"/>)");
  const Asked euler = ask(scene_of(cloth, R"(step="auto" integrator="explicit")"));
  EXPECT_EQ(euler.cause.of, Of::Scheme) << euler.cause.words;
  EXPECT_NEAR(ask(scene_of(cloth)).limit / euler.limit, euler.cause.gain, 1e-9 * euler.cause.gain);
}

TEST(StepCause, is_the_stiffness_of_the_stiffest_springs_otherwise) {
  const auto springs = [](const char* k) {
    return scene_of(sheet(std::string(R"(<stretch k=")") + k + R"("/><bend kind="provot" k="1"/>)"));
  };
  const Asked stiff = ask(springs("400"));
  EXPECT_EQ(stiff.cause.of, Of::Stiffness);
  EXPECT_THAT(stiff.cause.words,
              HasSubstr("body 'cloth': the stiffness of its springs 'stretch' limits the step"));
  EXPECT_NEAR(ask(springs("100")).limit / stiff.limit, stiff.cause.gain, 1e-9 * stiff.cause.gain);
  EXPECT_THAT(presets::load(springs("400"))->notes(), IsEmpty()) << "that is as usual";
}

// A grid of 12 × 12 quads whose seventh column and row are a twentieth as wide: where they cross is a small
// square, with the springs of all others.
std::string grid_with_a_small_square() {
  constexpr int n = 12;
  std::string text;
  const auto at = [](int i) { return i <= 6 ? 1.0 * i : i - 0.95; };
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) text += "v " + std::to_string(at(i)) + " " + std::to_string(at(j)) + " 0\n";
  const auto point = [](int i, int j) { return " " + std::to_string(j * (n + 1) + i + 1); };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      text += "f" + point(i, j) + point(i + 1, j) + point(i + 1, j + 1) + point(i, j + 1) + "\n";
  return text;
}

TEST(StepCause, is_a_light_element_which_it_names) {
  const files::Folder folder;
  const std::string mesh = folder.write("grid.obj", grid_with_a_small_square()).string();
  const Asked light = ask(scene_of(R"(<body name="grid"><mesh file=")" + mesh +
                                   R"("/><mass total="1"/><springs><stretch k="60"/></springs></body>)"));
  EXPECT_EQ(light.cause.of, Of::FewElements);
  EXPECT_THAT(light.cause.words,
              AllOf(HasSubstr("body 'grid': the quad"), HasSubstr("near (6.025, 6.025, 0) m (light: "),
                    HasSubstr("without the worst 1 of 144 elements")));
  EXPECT_NEAR(light.cause.gain, std::sqrt(20), 1e-6) << "of the square and of the quads beside it";
}

TEST(StepCause, says_how_many_bodies_limit_the_step_all_the_same) {
  const std::string damped = R"( damping-stiffness="0.02")";
  EXPECT_THAT(ask(scene_of(bar(damped, "one") + bar("", "two"))).cause.words, Not(HasSubstr("other")));
  EXPECT_THAT(
      ask(scene_of(bar(damped, "one") + bar(damped, "two"))).cause.words,
      AllOf(HasSubstr("body 'one'"), HasSubstr("if 1 other body that limits it too is changed as well")));
}

TEST(StepCause, is_told_where_it_makes_the_step_much_shorter_or_the_step_is_too_large) {
  EXPECT_THAT(
      presets::load(scene_of(bar(R"( damping-stiffness="0.02")")))->notes(),
      Contains(AllOf(HasSubstr("step=\"auto\" is "), HasSubstr("`damping-stiffness` of 0.02 s limits"))));
  EXPECT_THAT(
      presets::load(scene_of(bar(""), R"(step="0.5" integrator="symplectic")"))->notes(),
      Contains(AllOf(HasSubstr("may be too large"), HasSubstr("body 'ring': the stiffness of its elements"))));
}

TEST(StepCause, is_nothing_where_nothing_limits_the_step) {
  const Asked solved = ask(scene_of(bar(""), R"(step="0.01" integrator="implicit")"));
  EXPECT_EQ(solved.cause.of, Of::Nothing);
  EXPECT_THAT(solved.cause.words, IsEmpty());
}

} // namespace
} // namespace rend::step_cause_test
