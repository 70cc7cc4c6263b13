// What the figures of a run tell about laws and fragments, besides what is reached (reach_test.cpp).
#include "tests/render/commands/program_run.h"

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
  EXPECT_THAT(place.rend("run quad.xml -q").out,
              AllOf(HasSubstr(": never; largest value"), HasSubstr("times: " + why)));
  for (const json& one : place.rend("run quad.xml --reach --json -q").json()["reach"])
    EXPECT_TRUE(one["criterion"] != "cumulative-vertex" || one["reached"].is_null()) << one;
  EXPECT_THAT(place.rend("run quad.xml --reach -q").out,
              HasSubstr("cumulative-vertex of 'quad': no value: its change was possible nowhere"));
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
