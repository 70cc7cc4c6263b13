// Answers on the command line: the output and exit code of `rend run`, and that every preset of presets/verify
// satisfies its answers.
#include "tests/render/commands/program_run.h"
#include "tests/test_paths.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace rend::answers_test {
namespace {

using program::content;
using program::Outcome;
using program::TestFolder;
using testing::HasSubstr;
namespace fs = std::filesystem;

// A falling sheet, with answers about it.
std::string falling(const std::string& answers) {
  return R"(<scene name="falling"><body><sheet cells="1 1" size="1 1"/><mass total="1"/>
    <fix near="0 0 0"/><probe name="free" near="1 1 0"/><probe name="held" near="0 0 0"/>)" +
         answers + R"(</body><time step="0.1" integrator="verlet" duration="1"/></scene>)";
}

class Answers : public testing::Test {
protected:
  Outcome run(const std::string& answers, const std::string& options = "") const {
    place.write("falling.xml", falling(answers));
    return place.rend("run falling.xml --quiet " + options);
  }
  const TestFolder place;
  const std::string right =
      R"(<answer probe="free" quantity="dz" value="-4.905" tolerance="1e-9" source="g/2"/>)";
  const std::string wrong = R"(<answer probe="free" quantity="dz" value="-4.5" tolerance="0.05"/>)";
};

TEST_F(Answers, that_hold_end_with_0) {
  const Outcome outcome = run(right);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("free dz at 1 s is -4.905, measured -4.905"));
  EXPECT_THAT(outcome.out, HasSubstr("(g/2)"));
}

TEST_F(Answers, that_do_not_hold_end_with_1) {
  const Outcome outcome = run(right + wrong);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("DOES NOT HOLD"));
}

TEST_F(Answers, that_were_not_reached_are_neither) {
  const Outcome outcome = run(wrong, "--steps 5");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("not reached"));
  EXPECT_TRUE(run(wrong, "--steps 5 --json").json()["answers"][0]["holds"].is_null());
}

TEST_F(Answers, stand_among_the_figures) {
  const auto figures = run(right + wrong, "--json").json();
  const auto& answers = figures["answers"];
  ASSERT_EQ(answers.size(), 2u);
  EXPECT_EQ(answers[0]["probe"], "free");
  EXPECT_EQ(answers[0]["quantity"], "dz");
  EXPECT_EQ(answers[0]["at"], 1);
  EXPECT_EQ(answers[0]["source"], "g/2");
  EXPECT_EQ(answers[0]["holds"], true);
  EXPECT_EQ(answers[1]["holds"], false);
  EXPECT_NEAR(answers[1]["measured"].get<double>(), -4.905, 1e-12);
  EXPECT_NEAR(answers[1]["error"].get<double>(), -0.09, 1e-12);
  EXPECT_NEAR(figures["probes"]["held"]["reaction"][2].get<double>(), 9.81 / 4, 1e-12);
  EXPECT_FALSE(figures["probes"]["free"].contains("reaction"));
  EXPECT_NEAR(figures["probes"]["free"]["position"][2].get<double>(), -4.905, 1e-12);
}

TEST_F(Answers, leave_the_code_of_an_unstable_run) {
  place.write("stiff.xml", R"(<scene name="stiff"><body><sheet cells="3 3" size="1 1"/><mass total="1"/>
    <springs><stretch k="1e5"/></springs><fix side="-x"/><load side="+x" force="1 0 0"/>
    <probe name="p" side="+x"/><answer probe="p" quantity="dx" at="0" value="1"/></body>
    <time step="1e5" integrator="rk4" duration="1e7"/></scene>)");
  EXPECT_EQ(place.rend("run stiff.xml --quiet").code, 76);
}

TEST_F(Answers, and_probes_are_columns_of_the_diagnostics) {
  ASSERT_EQ(run(right, "--diagnostics d.csv").code, 0);
  const std::string csv = content(place.path() / "d.csv");
  const std::string header = csv.substr(0, csv.find('\n')), first = csv.substr(header.size() + 1);
  EXPECT_THAT(header, HasSubstr(",fragments,free_x,free_y,free_z,free_dx"));
  EXPECT_THAT(header, HasSubstr(",held_reaction_z"));
  EXPECT_EQ(std::count(header.begin(), header.end(), ','),
            std::count(first.begin(), first.begin() + static_cast<long>(first.find('\n')), ','));
  EXPECT_THAT(first, HasSubstr(",1,1,0,0,0,0,,,,0,0,0,0,0,0,0,0,2.4525"));
}

// Presets of presets/verify with their number of answers: none may lose one.
TEST(Verify, every_preset_holds) {
  const std::vector<std::pair<std::string, std::size_t>> presets{
      {"verify/bar-waves", 7},
      {"verify/beam-vibrations", 4},
      {"verify/cantilever-own-weight", 2},
      {"verify/cantilever-tip-load", 2},
      {"verify/catenary", 6},
      {"verify/cook-triangles", 1},
      {"verify/cook", 1},
      {"verify/elastica-1", 2},
      {"verify/elastica-5", 2},
      {"verify/free-fall", 2},
      {"verify/hanging-masses", 2},
      {"verify/hanging-rod", 2},
      {"verify/locking-parallelograms", 1},
      {"verify/locking-rectangles", 1},
      {"verify/locking-trapezoids", 1},
      {"verify/locking-triangles", 1},
      {"verify/oscillator", 5},
      {"verify/own-weight-1", 2},
      {"verify/own-weight-10", 2},
      {"verify/patch-hexahedra", 48},
      {"verify/patch-quads", 26},
      {"verify/patch-tetrahedra", 48},
      {"verify/patch-triangles", 26},
      {"verify/rectangle-springs", 4},
      {"verify/rod-own-weight", 2},
      {"verify/rotation", 7},
      {"verify/swelling", 5},
      {"verify/wind", 2},
  };
  const TestFolder place;
  for (const auto& [name, count] : presets) {
    const fs::path path = fs::path(test::source_root) / "presets" / (name + ".xml");
    const Outcome outcome = place.rend("run '" + path.string() + "' --json --quiet");
    EXPECT_EQ(outcome.code, 0) << name << outcome.err;
    const auto answers = outcome.json()["answers"];
    EXPECT_EQ(answers.size(), count) << name;
    for (const auto& answer : answers) {
      EXPECT_EQ(answer["holds"], true) << name << answer.dump();
      EXPECT_FALSE(answer["source"].get<std::string>().empty()) << name;
    }
  }
}

// Presets outside of the list would not be tested.
TEST(Verify, no_preset_is_without_an_answer) {
  const TestFolder place;
  for (const auto& entry : fs::directory_iterator(fs::path(test::source_root) / "presets/verify")) {
    if (entry.path().extension() != ".xml") continue;
    EXPECT_THAT(content(entry.path()), HasSubstr("<answer ")) << entry.path();
  }
}

} // namespace
} // namespace rend::answers_test
