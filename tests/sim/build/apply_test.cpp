// Where an <apply> applies: at one edge alone, selected by a box or found by a test in a script; and not where
// places overlap, of which it tells.
#include "sim/topology/isomorphism.h"
#include "tests/sim/presets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace rend::apply_test {
namespace {

// Of four quads in a row the rule takes two at a time: of the three edges between them one or two are left.
TEST(Apply, notes_the_places_that_it_skips) {
  const auto note_of = [](const std::string& body, const std::string& rule = "") {
    const auto loaded = presets::load("<scene>" + rule + "<body>" + body +
                                      R"xml(<mass total="1"/></body><time duration="0"/></scene>)xml");
    for (const std::string& note : loaded.body().notes)
      if (note.find("skipped") != std::string::npos) return note;
    return std::string();
  };
  const std::string pair = R"xml(<rule name="pair" left="a*(0,2) b(_,_) c(_,_) d(0,_) a-1-b b-0-c c-1-d"
      right="a(0,2) b(_,_) c(_,_) d(0,_) a-1-b b-0-c c-1-d"><when test="not free(a, 2)" at="all"/></rule>)xml";
  const std::string row = R"xml(<sheet cells="4 1" size="4 1"/>)xml";
  const std::string note = note_of(row + R"xml(<apply rule="pair" to="all"/>)xml", pair);
  std::size_t applied = 0, skipped = 0;
  ASSERT_EQ(std::sscanf(note.c_str(), "rule 'pair' was applied at %zu place%*[s, ]and skipped %zu place",
                        &applied, &skipped),
            2)
      << note;
  EXPECT_EQ(applied + skipped, 3u);
  EXPECT_GE(applied, 1u);
  EXPECT_GE(skipped, 1u);
  EXPECT_NE(note.find("times=\"2\" tries again"), std::string::npos) << note;
  EXPECT_EQ(note_of(row + R"xml(<subdivide/><apply rule="unsew-edge" to="all"/>)xml"), "");
}

// A star in each of 9 quads, and in the 36 triangles that these are then; all of a sheet is one place of
// quarter-faces; of the 3 edges within a row of 4 quads, one is opened.
TEST(Apply, counts_the_places) {
  const auto loaded = presets::load(R"xml(<scene>
    <body name="quarters"><sheet cells="3 3" size="1 1"/>
      <apply rule="star-face" times="2"/>
      <subdivide/>
      <mass total="1"/></body>
    <body name="opened"><sheet cells="4 1" size="4 1"/>
      <apply rule="unsew-edge" box="1 0 0 1 1 0"/><mass total="1"/></body>
    <time duration="0"/></scene>)xml");
  const AppliedRule &stars = loaded.body(0).applied.at(0), &subdivided = loaded.body(0).applied.at(1);
  EXPECT_EQ(stars.rule, "star-face");
  EXPECT_EQ(stars.line, 3);
  EXPECT_EQ(stars.applied, 9u + 36u);
  EXPECT_EQ(stars.skipped, 0u);
  EXPECT_EQ(subdivided.rule, "quarter-faces");
  EXPECT_EQ(subdivided.applied, 1u);
  const std::vector<AppliedRule>& opened = loaded.body(1).applied;
  ASSERT_EQ(opened.size(), 1u);
  EXPECT_EQ(opened[0].rule, "unsew-edge");
  EXPECT_EQ(opened[0].applied, 1u);
}

presets::Loaded sheet_with(const std::string& apply, const std::string& rules = "") {
  return presets::load("<scene>" + rules +
                       R"xml(<body><sheet pattern="triangles" cells="2 2" size="1 1"/>)xml" + apply +
                       R"xml(<mass total="1"/></body><time duration="0"/></scene>)xml");
}

double longest_edge(const EmbeddedMap& map) {
  double most = 0;
  map.map().for_each_dart([&](Dart d) {
    most = std::max(most, (map.position_of(d) - map.position_of(map.map().alpha(0, d))).norm());
  });
  return most;
}

// As presets/README.md has it: of the inner edges of a sheet one flips, to the other diagonal of its triangles.
TEST(OneEdge, is_selected_by_a_box_or_by_a_test_in_a_script) {
  const auto by_box = sheet_with(R"xml(<apply rule="flip-edge" box="0 0.5 0 0.5 0.5 0"/>)xml");
  const auto by_test = sheet_with(R"xml(<apply rule="flip-at" p="point(0.25, 0.5, 0)"/>)xml",
                                  R"xml(<script name="flip-at" hook="a*(0,1,2)">
      <where name="p" value="point(0, 0, 0)"/>
      <for each="e*(0,2)" where="norm(mean(e, edge) - p) &lt; 1e-3" apply="flip-edge"/></script>)xml");
  const EmbeddedMap &one = *by_box.body().map, &other = *by_test.body().map;
  EXPECT_TRUE(isomorphism(one.map(), other.map(), [&](Dart a, Dart b) {
    return (one.position_of(a) - other.position_of(b)).norm() < 1e-12;
  }));
  EXPECT_NEAR(longest_edge(*sheet_with("").body().map), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(longest_edge(one), std::hypot(0.5, 1.0), 1e-12);
}

} // namespace
} // namespace rend::apply_test
