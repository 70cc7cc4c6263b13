// Where a round applies a rule, and where it does not, against numbers of cells.
#include "sim/rules/rounds.h"

#include "sim/build/rule_book.h"
#include "tests/sim/assets.h"

#include <gtest/gtest.h>

namespace rend::rounds_test {
namespace {

RuleOrScript made(const std::string& rules) {
  return read_rules_text("<rules>" + rules + "</rules>", "test.xml").back();
}

RuleOrScript house_rule(const char* name) {
  return RuleOrScript(std::shared_ptr<const Rule>(std::shared_ptr<const Rule>(), &rule(name)));
}

// An edge between two quads with all of both, which changes nothing: it uses them up.
const std::string pair_of_quads = R"xml(<rule name="pair" left="a*(0,2) b(_,_) c(_,_) d(0,_) a-1-b b-0-c c-1-d"
    right="a(0,2) b(_,_) c(_,_) d(0,_) a-1-b b-0-c c-1-d">
  <when test="not free(a, 2)" at="all" otherwise="the edge lies on the border"/></rule>)xml";

// Of n x m quads there are n (m - 1) + m (n - 1) inner edges, and each is a place where the rule fits.
TEST(Rounds, apply_or_skip_each_place_that_fits) {
  for (const auto& [n, m] : {std::pair(2, 1), std::pair(4, 1), std::pair(3, 3), std::pair(5, 4)}) {
    const auto sheet = assets::grid(n, m);
    const RuleOrScript pair = made(pair_of_quads);
    RuleOrScriptRunner runner(pair);
    const RoundResult result = apply_round(*sheet, runner);
    const auto inner = static_cast<std::size_t>(n * (m - 1) + m * (n - 1));
    EXPECT_EQ(result.applied + result.skipped, inner) << n << " x " << m;
    EXPECT_GE(result.applied, 1u);
    EXPECT_LE(2 * result.applied, static_cast<std::size_t>(n * m)) << "each uses two quads up";
    EXPECT_EQ(result.reason, result.refused > 0 ? "the edge lies on the border" : "");
  }
}

// What is done from one side is not left over on the other, and what a round makes is none of its places.
TEST(Rounds, skip_nothing_where_places_do_not_overlap) {
  const auto sheet = assets::grid(3, 2);
  const RuleOrScript unsew = house_rule("unsew-edge"), quarter = house_rule("quarter-faces");
  RuleOrScriptRunner divides(quarter), parts(unsew);
  const RoundResult divided = apply_round(*sheet, divides);
  EXPECT_EQ(divided.skipped, 0u);
  EXPECT_EQ(divided.refused, 0u);
  const RoundResult parted = apply_round(*sheet, parts); // 6 x 4 quads now
  EXPECT_EQ(parted.applied, 6u * 3 + 5 * 4);
  EXPECT_EQ(parted.skipped, 0u);
  EXPECT_EQ(parted.refused, 2u * (6 + 4)) << "the sides on the border";
  EXPECT_EQ(count_cells(sheet->map()).fragments, 24u);
}

TEST(Rounds, do_not_count_places_that_are_not_selected) {
  const auto sheet = assets::grid(4, 1);
  const RuleOrScript pair = made(pair_of_quads);
  RuleOrScriptRunner runner(pair);
  const auto on_the_left = [&](Dart d) { return sheet->position_of(d).x() < 1.5; }; // of three inner edges one
  const RoundResult result = apply_round(*sheet, runner, on_the_left);
  EXPECT_EQ(result.applied, 1u);
  EXPECT_EQ(result.skipped, 0u);
}

} // namespace
} // namespace rend::rounds_test
