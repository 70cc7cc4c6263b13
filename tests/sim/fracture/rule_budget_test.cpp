// A law whose rule lets a body grow waits where there is no room left, and counts that.
#include "sim/boundary/face_sense.h"
#include "sim/fracture/rule_change.h"
#include "sim/house_rules/house_scripts.h"
#include "tests/sim/assets.h"
#include "tests/sim/fracture/torn_bodies.h"

#include <gtest/gtest.h>

namespace rend::rule_budget_test {
namespace {

using Findings = torn::RandomCriterion<Cell::Elements>;

// A sheet that a rule changes at faces found at random.
std::unique_ptr<Body> starred_at_random(const MapBudget& budget) {
  auto map = assets::grid(3, 3);
  map->let_grow();
  map->add(FaceSense{});
  auto body = torn::body(std::move(map));
  LawSettings law{.criterion = &torn::chance_on(Cell::Elements), .rule = "star-face", .cell = Cell::Elements};
  law.by_rule = change_by(*find_house_rule_or_script("star-face"), 2, nullptr, budget);
  law.change = law.by_rule.get();
  body->tear_laws.emplace_back(body->request_for(law), law);
  return body;
}

// Of a body of 72 darts.
void expect_to_wait(const MapBudget& budget) {
  const auto body = starred_at_random(budget);
  Findings::found.clear();
  std::size_t made = 0, room = 0;
  for (int n = 0; n < 100; ++n) {
    room = most_darts(*body->map, budget);
    made += static_cast<std::size_t>(body->tear(0.1 * n, n, [] {}));
    ASSERT_LE(body->map->map().dart_count(), room);
  }
  EXPECT_GT(made, 2u);
  EXPECT_GT(body->map->map().dart_count() + 16, room); // a quad, which gets 16 more, would not fit
  EXPECT_EQ(body->events.size(), made);
  const Refusals& refusals = body->tear_laws[0].refusals();
  ASSERT_EQ(refusals.size(), 1u);
  EXPECT_EQ(refusals.begin()->first, beyond_budget);
  EXPECT_EQ(refusals.begin()->second, Findings::found.size() - made);
}

TEST(RuleBudget, a_law_waits_where_there_is_no_room_for_darts) {
  expect_to_wait({.darts = 150});
}

TEST(RuleBudget, a_law_waits_where_there_is_no_room_for_their_bytes) {
  const std::size_t darts = 150, most = most_darts(*starred_at_random({})->map);
  EXPECT_LT(most, MapBudget{}.darts / 2); // masses are inherited, and elements have values
  const std::size_t bytes_of_dart = MapBudget{}.bytes / most;
  expect_to_wait({.bytes = darts * bytes_of_dart});
}

} // namespace
} // namespace rend::rule_budget_test
