// What the figures of a run tell about laws and fragments, besides what is reached (reach_test.cpp).
#include "tests/render/commands/program_run.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace rend::law_figures_test {
namespace {

using nlohmann::json;
using program::Outcome;
using program::TestFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class LawFigures : public testing::Test {
protected:
  LawFigures() { place.write("pulled.xml", program::pulled); }
  const TestFolder place;
};

TEST_F(LawFigures, say_that_a_law_tears_in_its_first_steps) {
  const Outcome early = place.rend("run pulled.xml --set body.tear.threshold=1e-9");
  EXPECT_THAT(early.out, AllOf(HasSubstr("in the law's step "), HasSubstr("is the threshold meant in N")));
  EXPECT_THAT(early.err, AllOf(HasSubstr("the law 'global-border' of body 'cloth' tears in its step "),
                               HasSubstr("with a threshold of 1e-09 N")));
  const Outcome later = place.rend("run pulled.xml");
  EXPECT_THAT(later.out + later.err, Not(HasSubstr("is the threshold meant")));
  EXPECT_THAT(later.out, HasSubstr("first at "));
  const auto law = [&](const char* options) {
    return place.rend(std::string("run pulled.xml --json -q ") + options).json()["laws"][0];
  };
  EXPECT_EQ(law("")["at_once"], false);
  EXPECT_EQ(law("--set body.tear.threshold=1e-9")["at_once"], true);
}

// The first step of a law that begins later is that at which it begins.
TEST_F(LawFigures, count_the_steps_of_a_law_from_its_start) {
  const std::string late = "run pulled.xml --json -q --set body.tear.threshold=1e-9 --set body.tear.from=0.05";
  const json law = place.rend(late).json()["laws"][0];
  EXPECT_EQ(law["at_once"], true);
  EXPECT_NEAR(law["first"], 0.05, 1e-9);
}

// A single quad that hangs by a corner: no vertex of it can be split.
TEST_F(LawFigures, say_why_a_law_never_tears_where_its_threshold_is_exceeded) {
  place.write("quad.xml", R"(<scene name="quad"><body name="quad"><sheet cells="1 1" size="1 1"/>
    <place rotate="90 0 0"/><mass total="0.1"/><springs><stretch k="60"/></springs><fix near="0 0 1"/>
    <tear criterion="cumulative-vertex" threshold="0.1"/></body><time step="1e-3" duration="0.2"/></scene>)");
  const json figures = place.rend("run quad.xml --json -q").json(), law = figures["laws"][0];
  EXPECT_EQ(law["tears"], 0);
  EXPECT_GT(law["reached"]["value"], law["threshold"]);
  const std::string why = "all elements at the vertex lie on one side of the plane across the force";
  ASSERT_TRUE(law["refused"].contains(why)) << law;
  EXPECT_GT(law["refused"][why], 10);
  EXPECT_EQ(law["never"], "not possible");
  EXPECT_THAT(place.rend("run quad.xml -q").out,
              AllOf(HasSubstr(": never; largest value"), HasSubstr("times: " + why)));
  for (const json& one : place.rend("run quad.xml --reach --json -q").json()["reach"])
    EXPECT_TRUE(one["criterion"] != "cumulative-vertex" || one["reached"].is_null()) << one;
  EXPECT_THAT(place.rend("run quad.xml --reach -q").out,
              HasSubstr("cumulative-vertex of 'quad': no value: its change was possible nowhere"));
}

TEST_F(LawFigures, say_why_a_law_never_tears_where_it_is_not_exceeded) {
  const auto words_and_law = [&](const std::string& set) {
    const std::string line = "run pulled.xml -q --set body.tear.threshold=1e9 " + set;
    return std::pair(place.rend(line).out, place.rend(line + " --json").json()["laws"][0]);
  };
  const auto [plain, law] = words_and_law("");
  EXPECT_EQ(law["never"], "below threshold");
  EXPECT_EQ(law["relative"], false);
  EXPECT_THAT(plain, Not(HasSubstr("in its time")));
  const auto [late, of_late] = words_and_law("--set body.tear.from=7");
  EXPECT_EQ(of_late["never"], "not in time");
  EXPECT_TRUE(of_late["reached"].is_null());
  EXPECT_THAT(late, HasSubstr(": never: no step was in its time, from 7 s on\n"));
  const auto [short_, of_short] = words_and_law("--set body.tear.from=0.01 --set body.tear.until=0.05");
  EXPECT_EQ(of_short["never"], "below threshold");
  EXPECT_LT(of_short["reached"]["value"], law["reached"]["value"]); // it is pulled more later on
  EXPECT_THAT(short_, HasSubstr("never; largest value, in its time, from 0.01 s to 0.05 s, sampled every "));
  const auto [part, of_part] = words_and_law("--set body.tear.side=-x --set body.tear.strength=4");
  EXPECT_EQ(of_part["relative"], true);
  EXPECT_THAT(part, HasSubstr(", among what it selects, divided by the strength there"));
  // One that tears does not say why it does not.
  EXPECT_TRUE(place.rend("run pulled.xml -q --json").json()["laws"][0]["never"].is_null());
  // What nothing pulls has no value.
  place.write("still.xml",
              R"(<scene name="still"><body name="s"><sheet cells="2 2" size="1 1"/><mass total="1"/>
    <springs><stretch k="1"/></springs><tear criterion="global-border" threshold="1"/></body>
    <world gravity="0 0 0"/><time step="1e-3" duration="0.05"/></scene>)");
  EXPECT_EQ(place.rend("run still.xml -q --json").json()["laws"][0]["never"], "no value");
  EXPECT_THAT(place.rend("run still.xml -q").out, HasSubstr(": never; no value above 0\n"));
}

// Values below the threshold are looked at in some steps alone: of a law whose time has none of these, it is
// not said that nothing was above 0.
TEST_F(LawFigures, say_no_more_of_a_law_than_was_looked_at) {
  const json whole = place.rend("run pulled.xml -q --json --set body.tear.threshold=1e9").json();
  const double step = whole["step"], every = whole["laws"][0]["look_every"];
  ASSERT_GT(every, 2);
  const auto law_of_step = [&](double number) {
    return place
        .rend(fmt::format("run pulled.xml -q --json --set body.tear.threshold=1e9 --set body.tear.from={} "
                          "--set body.tear.until={}",
                          (number - 0.5) * step, (number + 0.5) * step))
        .json()["laws"][0];
  };
  EXPECT_GT(law_of_step(2 * every)["reached"]["value"], 0);
  const json between = law_of_step(2 * every + 1);
  EXPECT_TRUE(between["reached"].is_null());
  EXPECT_EQ(between["never"], "below threshold");
}

// Two halves of a sheet of four rows: the wall between them has an edge in each row and five vertices, all of
// which exceed the threshold at once. Each opens an edge; the last one finds none that is left.
TEST_F(LawFigures, say_where_no_wall_between_pieces_is_left_to_part) {
  place.write("halves.xml", R"(<scene name="halves"><body name="b">
    <sheet pattern="triangles" cells="8 4" size="0.8 0.4"/><pieces count="2" pattern="slabs" strength="0.01"/>
    <mass total="1"/><elasticity young="1e4" poisson="0" thickness="0.01"/>
    <drive all="yes" gradient="0 0 0 0 0.01 0 0 0 0"/>
    <tear criterion="vertex-stress" threshold="1e3" change="separate"/></body>
    <world gravity="0 0 0"/><time step="1e-4" duration="0.01"/></scene>)");
  const json figures = place.rend("run halves.xml --json -q").json(), law = figures["laws"][0];
  EXPECT_EQ(law["tears"], 4);
  EXPECT_EQ(figures["fragments"], 2);
  EXPECT_TRUE(law["never"].is_null());
  EXPECT_EQ(law["relative"], true);
  EXPECT_NEAR(law["reached"]["value"], 1e4, 200); // 100 Pa, divided by a hundredth
  EXPECT_EQ(law["refused"].dump(),
            R"({"at walls it parts pieces alone, and no wall is left to part there":1})");
}

TEST_F(LawFigures, tell_the_sizes_of_fragments) {
  const json torn = place.rend("run pulled.xml --json -q").json(), sizes = torn["fragment_sizes"];
  ASSERT_GT(torn["fragments"], 1);
  EXPECT_EQ(1 + sizes["others_above_1_percent"].get<int>() + sizes["others_below_1_percent"].get<int>(),
            torn["fragments"].get<int>());
  EXPECT_GE(sizes["largest"].get<double>(), 1 / torn["fragments"].get<double>());
  EXPECT_LT(sizes["largest"], 1);
  EXPECT_THAT(place.rend("run pulled.xml -q").out,
              HasSubstr(std::to_string(torn["fragments"].get<int>()) + " fragments: one with "));
  const json whole = place.rend("run pulled.xml --json -q --set body.tear.threshold=1e9").json();
  EXPECT_EQ(whole["fragments"], 1);
  EXPECT_EQ(whole["fragment_sizes"]["largest"], 1);
}

} // namespace
} // namespace rend::law_figures_test
