// A signal within a step is answered within 5 s, by every scheme and every command that makes steps.
//
// By default with a step that never ends, and a large static solve; with REND_WHOLE in the environment with all
// schemes, a redone stretch of steps, and a long build (tests/run --all).
#include "sim/base/wall_clock.h"
#include "tests/render/clip/stopped_clip.h"
#include "tests/render/needs.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace rend::stop_test {
namespace {

using program::Outcome;
using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr double most_seconds = 5;

bool whole() {
  return std::getenv("REND_WHOLE") != nullptr;
}

class Stop : public program::StoppedClip {
protected:
  Stop() {
    // rk45 divides a step into millions of parts
    place.write("endless.xml", R"(<scene name="endless">
  <body name="bar"><bar cells="6 3 3" size="1 0.5 0.5"/><mass total="1"/>
    <elasticity young="1e9" poisson="0.3"/><fix side="-x"/></body>
  <world gravity="0 0 -9.81"/>
  <time step="0.05" duration="5" integrator="rk45" tolerance="1e-14"/>
</scene>)");
    place.write("large.xml", R"(<scene name="large">
  <body name="block"><bar cells="40 40 40" size="1 1 1"/><mass total="1000"/>
    <elasticity young="1e6" poisson="0.3" damping-mass="1"/>
    <fix side="-x"/><load side="+x" force="0 0 -1e4"/></body>
  <world gravity="0 0 -9.81"/>
  <time step="0.02" duration="10" integrator="implicit"/>
</scene>)");
  }

  // Sends a signal after some time [s], and another 0.5 s later where `twice`; expects an end within 5 s, and
  // no temporary file.
  Outcome answer(const std::string& arguments, double after, bool twice = false) const {
    const Outcome outcome = place.shell(fmt::format(
        "{} {} & pid=$!; sleep {:.2f}; kill -0 $pid && kill -TERM $pid; from=$(date +%s%N); {} wait $pid; "
        "code=$?; echo; echo took $((($(date +%s%N) - from) / 1000000)); exit $code",
        test::rend_program, arguments, after, twice ? "sleep 0.5; kill -TERM $pid;" : ""));
    EXPECT_EQ(outcome.code, 143) << arguments << "\n" << outcome.out << outcome.err;
    const std::size_t at = outcome.out.rfind("took ");
    EXPECT_LT(std::stod(outcome.out.substr(at + 5)) / 1000, most_seconds) << arguments;
    for (const std::string& name : place.files()) EXPECT_FALSE(name.ends_with(".part")) << arguments << name;
    return outcome;
  }
};

TEST_F(Stop, within_a_step_is_answered_by_every_command) {
  NEEDS_PNG;
  for (const char* arguments :
       {"run endless.xml --diagnostics d.csv --events e.csv", "sheet endless.xml -o s.png", "check endless.xml",
        "batch endless.xml -o b --memory 4G"})
    answer(arguments, 1);
  EXPECT_TRUE(fs::exists(place.path() / "d.csv")) << "what was measured is kept";
  EXPECT_TRUE(fs::exists(place.path() / "e.csv"));
  EXPECT_TRUE(fs::exists(place.path() / "b/index.html"));
  EXPECT_FALSE(fs::exists(place.path() / "s.png"));
}

TEST_F(Stop, within_a_step_leaves_a_checkpoint_of_its_start) {
  NEEDS_PNG;
  const Outcome outcome = answer("render endless.xml -o c", 1);
  EXPECT_THAT(outcome.err, HasSubstr("repeat the command with --resume"));
  EXPECT_EQ(in("c").count("endless.checkpoint"), 1u);
  EXPECT_THAT(answer("render endless.xml -o c --resume", 1).err, HasSubstr("continuing at 0 s"));
}

TEST_F(Stop, asked_for_twice_is_answered_at_once_and_leaves_no_temporary_file) {
  answer("run endless.xml --diagnostics d.csv", 1, true);
  EXPECT_FALSE(fs::exists(place.path() / "d.csv"));
}

TEST_F(Stop, within_a_step_is_answered_by_every_scheme) {
  const auto start = wall_clock();
  EXPECT_EQ(place.rend("run large.xml -q --steps 0").code, 0);
  const double building = 1.2 * (wall_clock() - start) + 1; // [s]
  std::vector<std::string> sets{"time.integrator=static --set time.step=10"};
  if (whole())
    for (const char* more : {"time.integrator=implicit", "time.integrator=tr-bdf2", "time.integrator=alpha",
                             "time.integrator=rk45 --set time.tolerance=1e-14", "time.integrator=symplectic",
                             "time.integrator=verlet", "time.integrator=midpoint", "time.integrator=rk4",
                             "time.integrator=explicit"})
      sets.emplace_back(more);
  for (const std::string& set : sets) answer("run large.xml --set " + set, building);
  if (whole()) answer("study large.xml -o study", 2 * building);
}

TEST_F(Stop, while_a_check_builds_its_scenes_is_answered) {
  if (!whole()) GTEST_SKIP() << "takes half a minute";
  std::string preset = program::pulled;
  preset.replace(preset.find("cells=\"6 6\""), 11, "cells=\"200 200\"");
  preset.replace(preset.find("<place"), 0, "<apply rule=\"quarter-faces\" times=\"3\"/>");
  place.write("grown.xml", preset);
  for (const double after : {0.5, 3.0, 6.0}) answer("check grown.xml", after);
}

} // namespace
} // namespace rend::stop_test
