// What rules may make of a map: they are refused before it grows too large, and leave it as it was.
#include "sim/rules/map_budget.h"

#include "sim/base/archive.h"
#include "sim/build/rule_book.h"
#include "sim/rules/rounds.h"
#include "tests/sim/assets.h"

#include <gtest/gtest.h>

namespace rend::map_budget_test {
namespace {

std::vector<std::uint8_t> bytes_of(EmbeddedMap& body) {
  Archive archive;
  body.store(archive);
  return archive.bytes();
}

RuleOrScript house_rule(const char* name) {
  return RuleOrScript(std::shared_ptr<const Rule>(std::shared_ptr<const Rule>(), &rule(name)));
}

RuleOrScript made(const std::string& rules) {
  return read_rules_text("<rules>" + rules + "</rules>", "test.xml").back();
}

// star-face makes three darts of each: two more.
constexpr std::size_t darts_of_quad = 8, of_starred_quad = 24;

TEST(MapBudget, a_round_is_counted_before_it_begins) {
  const RuleOrScript star = house_rule("star-face");
  const auto sheet = assets::grid(3, 3);
  const auto before = bytes_of(*sheet);
  RuleOrScriptRunner tight(star, {.most_darts = 9 * of_starred_quad - 1});
  const RoundResult refused = apply_round(*sheet, tight);
  EXPECT_TRUE(refused.over_budget);
  EXPECT_EQ(refused.applied, 0u);
  EXPECT_EQ(refused.places, 9u);
  EXPECT_EQ(refused.darts, 9 * of_starred_quad);
  EXPECT_EQ(bytes_of(*sheet), before);
  RuleOrScriptRunner exact(star, {.most_darts = 9 * of_starred_quad});
  const RoundResult done = apply_round(*sheet, exact);
  EXPECT_FALSE(done.over_budget);
  EXPECT_EQ(done.applied, 9u);
  EXPECT_EQ(sheet->map().dart_count(), 9 * of_starred_quad);
}

TEST(MapBudget, what_is_not_selected_and_what_does_not_match_counts_nothing) {
  const auto sheet = assets::grid(3, 3);
  const auto at_origin = [&](Dart d) { return sheet->position_of(d).head<2>().maxCoeff() <= 1; };
  const std::size_t one_more = 8 * darts_of_quad + of_starred_quad;
  const RuleOrScript star = house_rule("star-face");
  RuleOrScriptRunner tight(star, {.most_darts = one_more - 1});
  EXPECT_TRUE(apply_round(*sheet, tight, at_origin).over_budget);
  RuleOrScriptRunner exact(star, {.most_darts = one_more});
  EXPECT_EQ(apply_round(*sheet, exact, at_origin).applied, 1u);
  // Five darts or more: of the starred face, none of its triangles.
  const RuleOrScript where = made(R"xml(<rule name="large" left="a*(0,1) a|3"
      right="a(0,_) b(_,2) c(1,2) a-1-b b-0-c a|3 b|3 c|3"><set node="c" position="mean(a, face)"/>
      <when test="x(a) > 2.5" at="any"/></rule>)xml");
  RuleOrScriptRunner few(where, {.most_darts = one_more + 3 * (of_starred_quad - darts_of_quad)});
  const RoundResult right_column = apply_round(*sheet, few);
  EXPECT_FALSE(right_column.over_budget);
  EXPECT_EQ(right_column.applied, 3u);
}

TEST(MapBudget, a_round_of_a_script_is_taken_back) {
  const RuleOrScript script = made(R"xml(<script name="s" hook="a*(0,1)">
      <for each="e*(0,1)" apply="star-face" at-least="none"/></script>)xml");
  const auto sheet = assets::grid(3, 3);
  const auto before = bytes_of(*sheet);
  RuleOrScriptRunner runner(script, {.most_darts = 9 * of_starred_quad - 1});
  const RoundResult refused = apply_round(*sheet, runner);
  EXPECT_TRUE(refused.over_budget);
  EXPECT_EQ(bytes_of(*sheet), before);
  runner.context().most_darts = 9 * of_starred_quad;
  EXPECT_EQ(apply_round(*sheet, runner).applied, 9u);
}

TEST(MapBudget, a_rule_that_does_not_grow_a_map_applies_to_one_that_is_too_large) {
  const auto sheet = assets::grid(2, 1);
  const RuleOrScript unsew = house_rule("unsew-edge"), star = house_rule("star-face");
  RuleOrScriptRunner parts(unsew, {.most_darts = 1}), grows(star, {.most_darts = 1});
  EXPECT_EQ(apply_round(*sheet, parts).applied, 1u);
  EXPECT_TRUE(apply_round(*sheet, grows).over_budget);
}

struct LargeValue {
  using Value = std::array<double, 64>;
  std::string name = "large";
  Orbit orbit = FaceOfVolume, support = FaceOfVolume;
  Value birth(const EmbeddedMap&, Dart) const { return {}; }
  Value split(const Value& whole) const { return whole; }
};

TEST(MapBudget, values_count_and_what_was_removed_does_not_lower_it) {
  const auto sheet = assets::grid(4, 4);
  const MapBudget budget{.darts = std::size_t{1} << 40U, .bytes = std::size_t{1} << 30U};
  const std::size_t plain = most_darts(*sheet, budget);
  EXPECT_GT(plain, budget.bytes / 400);
  EXPECT_LT(plain, budget.bytes / 100);
  EXPECT_EQ(most_darts(*sheet, {.darts = 1000, .bytes = budget.bytes}), 1000u);
  sheet->add(LargeValue{}); // 512 bytes for 8 darts, twice
  const std::size_t large = most_darts(*sheet, budget);
  EXPECT_NEAR(static_cast<double>(budget.bytes) / static_cast<double>(large),
              static_cast<double>(budget.bytes) / static_cast<double>(plain) + 2 * 64 + 4, 1.5);
  sheet->edit([&](Edit& edit) {
    for (int n = 0; n < 15; ++n) assets::remove_element(edit, Dart{static_cast<std::uint32_t>(n * 8)});
  });
  EXPECT_EQ(sheet->map().dart_count(), darts_of_quad);
  EXPECT_EQ(most_darts(*sheet, budget), large);
}

} // namespace
} // namespace rend::map_budget_test
