// A rule of a law that makes what cannot be simulated: the run ends with its time and name, and what was
// written until then stays.
#include "tests/render/commands/program_run.h"
#include "tests/render/needs.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace rend::rule_stop_test {
namespace {

using program::content;
using program::Outcome;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
namespace fs = std::filesystem;

std::string pulled_by(const std::string& matter, const std::string& to) {
  return R"xml(<scene name="pulled">
  <rule name="shift" left="a*(1,2,3)" right="a(1,2,3)">
    <set node="a" position=")xml" +
         to + R"xml(" rest=")xml" + to + R"xml("/></rule>
  <body name="sheet"><sheet pattern="triangles" cells="8 4" size="0.8 0.4"/>
    <mass density="1000" thickness="1e-3"/>)xml" +
         matter + R"xml(
    <drive side="-x" velocity="-0.3 0 0"/><drive side="+x" velocity="0.3 0 0"/>
    <tear criterion="atomic-vertex" threshold="0.02" rule="shift" max-per-step="3"/>
  </body>
  <world gravity="0 0 0"/><time step="1e-4" duration="0.2"/><image size="64 64" fps="10000"/>
</scene>)xml";
}

const std::string springs =
    R"xml(<springs young="2e5" poisson="0.3" thickness="1e-3"><stretch damping="0.01"/></springs>)xml";
const std::string elasticity =
    R"xml(<elasticity young="2e5" poisson="0.3" thickness="1e-3" damping-mass="50"/>)xml";

long lines_of(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n');
}

class RunRuleStop : public testing::Test {
protected:
  const program::TestFolder place;
};

TEST_F(RunRuleStop, ends_with_76_the_time_and_the_rule_and_keeps_what_was_written) {
  place.write("pulled.xml", pulled_by(springs, "a + point(0.03, 0, 0)"));
  const Outcome run = place.rend("run pulled.xml -q --json --events e.jsonl --diagnostics d.csv");
  EXPECT_EQ(run.code, 76);
  EXPECT_THAT(run.err,
              AllOf(HasSubstr("pulled.xml:7:"), HasSubstr("the simulation was stopped at "),
                    HasSubstr("because 'shift' makes what it cannot go on with"), HasSubstr("hint: ")));
  const nlohmann::json figures = run.json();
  EXPECT_EQ(figures["stopped"], "unstable");
  EXPECT_GT(figures["steps"], 0);
  EXPECT_EQ(lines_of(content(place.path() / "e.jsonl")), figures["tears"].get<long>());
  EXPECT_GT(figures["tears"], 0);
  EXPECT_GT(lines_of(content(place.path() / "d.csv")), figures["steps"].get<long>()); // and the head
}

TEST_F(RunRuleStop, keeps_its_pictures) {
  NEEDS_PNG;
  place.write("pulled.xml", pulled_by(springs, "a + point(0.03, 0, 0)"));
  const Outcome render = place.rend("render pulled.xml -q -o frames");
  EXPECT_EQ(render.code, 76);
  EXPECT_THAT(render.err, HasSubstr("because 'shift' makes"));
  std::size_t pictures = 0;
  for (const auto& file : fs::directory_iterator(place.path() / "frames"))
    pictures += file.path().extension() == ".png";
  EXPECT_GT(pictures, 1u);
}

TEST_F(RunRuleStop, is_not_needed_where_the_change_is_refused) {
  place.write("pulled.xml", pulled_by(elasticity, "point(x(a), 0.1, 0)"));
  const Outcome run = place.rend("run pulled.xml -q --events e.jsonl");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("times: it would make an element flat or inside out"));
  EXPECT_GT(lines_of(content(place.path() / "e.jsonl")), 0);
}

} // namespace
} // namespace rend::rule_stop_test
