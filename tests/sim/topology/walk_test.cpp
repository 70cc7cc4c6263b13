#include "sim/topology/walk.h"

#include "tests/sim/assets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace rend::walk_test {
namespace {

// By definition: everything reachable by the links.
std::set<Dart> naive(const GMap& map, Orbit orbit, Dart d) {
  std::set<Dart> found{d};
  std::vector<Dart> stack{d};
  while (!stack.empty()) {
    const Dart at = stack.back();
    stack.pop_back();
    for (int i = 0; i < 4; ++i)
      if (orbit.has(i) && found.insert(map.alpha(i, at)).second) stack.push_back(map.alpha(i, at));
  }
  return found;
}

Orbit orbit_of(int mask) {
  Orbit orbit;
  orbit.mask = static_cast<std::uint8_t>(mask);
  return orbit;
}

void expect_walks_right(const GMap& map) {
  for (int mask = 0; mask < orbit_kinds; ++mask) {
    map.for_each_dart([&](Dart d) {
      const std::vector<Dart> walked = darts_of(map, orbit_of(mask), d);
      const std::set<Dart> expected = naive(map, orbit_of(mask), d);
      ASSERT_EQ(walked.front(), d);
      ASSERT_EQ(walked.size(), expected.size()) << name(orbit_of(mask)) << " of " << d.value;
      ASSERT_EQ(std::set<Dart>(walked.begin(), walked.end()), expected);
      ASSERT_EQ(smallest_dart(map, orbit_of(mask), d), *expected.begin());
    });
  }
}

TEST(Walk, every_orbit_of_every_asset_is_what_the_links_lead_to) {
  for (const auto& asset : assets::all()) {
    SCOPED_TRACE(asset.name);
    expect_walks_right(asset.make()->map());
  }
}

TEST(Walk, every_orbit_of_random_surfaces_is_what_the_links_lead_to) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    expect_walks_right(assets::random_sewing(seed, 8, static_cast<int>(seed) * 40)->map());
  }
}

TEST(Walk, every_orbit_of_random_solids_is_what_the_links_lead_to) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    GMap map(3);
    MapEdit edit(map);
    std::vector<Vec3> place;
    for (int n = 0; n < 4; ++n) assets::add_cube(edit, place, Vec3(n, 0, 0));
    for (int n = 0; n < 40; ++n) sew(edit, 3, Dart{random() % map.capacity()}, Dart{random() % map.capacity()});
    expect_walks_right(map);
  }
}

TEST(Walk, a_sheets_vertex_is_walked_around_without_alpha3) {
  const auto body = assets::grid(3, 3);
  for (Dart d : assets::all_darts(body->map())) {
    std::vector<Dart> walked;
    walk_sheet_vertex(body->map(), d, [&](Dart e) { walked.push_back(e); });
    EXPECT_EQ(walked, darts_of(body->map(), Vertex, d));
  }
}

TEST(Walk, same_cell_tells_neighbours_from_strangers) {
  const auto body = assets::grid(2, 1);
  const GMap& map = body->map();
  EXPECT_TRUE(same_cell(map, FaceOfVolume, Dart{0u}, map.alpha(0, map.alpha(1, Dart{0u}))));
  EXPECT_FALSE(same_cell(map, FaceOfVolume, Dart{0u}, Dart{8u}));
  EXPECT_TRUE(same_cell(map, Component, Dart{0u}, Dart{8u}));
}

TEST(IndexSet, remembers_until_it_is_cleared) {
  IndexSet set;
  EXPECT_FALSE(set.contains(7));
  for (std::uint32_t n = 0; n < 1000; ++n) EXPECT_TRUE(set.insert(8 * n));
  for (std::uint32_t n = 0; n < 1000; ++n) EXPECT_FALSE(set.insert(8 * n));
  EXPECT_TRUE(set.contains(8 * 999));
  EXPECT_FALSE(set.contains(7));
  set.clear();
  EXPECT_FALSE(set.contains(8));
  EXPECT_TRUE(set.insert(8));
}

TEST(IndexMap, keeps_the_first_value_of_insert_and_the_last_of_assign) {
  IndexMap map;
  EXPECT_EQ(map.find(3), IndexMap::none);
  EXPECT_EQ(map.insert(3, 30), 30u);
  EXPECT_EQ(map.insert(3, 31), 30u);
  map.assign(3, 32);
  EXPECT_EQ(map.find(3), 32u);
  EXPECT_EQ(map.size(), 1u);
}

} // namespace
} // namespace rend::walk_test
