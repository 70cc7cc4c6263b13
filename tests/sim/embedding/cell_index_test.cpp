#include "sim/embedding/cell_index.h"

#include "sim/embedding/embedded_map.h"
#include "tests/sim/assets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace rend::cell_index_test {
namespace {

Orbit orbit_of(int mask) {
  Orbit orbit;
  orbit.mask = static_cast<std::uint8_t>(mask);
  return orbit;
}

// Every orbit has one slot and every live slot one orbit, whose smallest dart it records.
void expect_sound(const GMap& map, const CellIndex& cells) {
  std::set<Slot> met;
  std::vector<char> seen(map.capacity(), 0);
  map.for_each_dart([&](Dart first) {
    if (seen[first.value]) return;
    const Slot slot = cells.slot(first);
    ASSERT_NE(slot, no_slot);
    ASSERT_TRUE(met.insert(slot).second) << "slot " << slot << " has two orbits";
    ASSERT_EQ(cells.first_dart(slot), first);
    for (Dart d : darts_of(map, cells.orbit(), first)) {
      seen[d.value] = 1;
      ASSERT_EQ(cells.slot(d), slot);
    }
  });
  ASSERT_EQ(cells.count(), met.size());
  for (Slot s = 0; s < cells.slots(); ++s) ASSERT_EQ(cells.alive(s), met.count(s) == 1);
}

// The darts of each orbit, by slot.
std::map<Slot, std::vector<Dart>> orbits(const GMap& map, const CellIndex& cells) {
  std::map<Slot, std::vector<Dart>> all;
  map.for_each_dart([&](Dart d) { all[cells.slot(d)].push_back(d); });
  return all;
}

struct CellStorm {
  explicit CellStorm(unsigned seed) : random(seed) {}

  Dart any() {
    const std::vector<Dart> darts = assets::all_darts(map);
    return darts[random() % darts.size()];
  }

  void add_face() {
    MapEdit edit(map, &journal);
    const std::size_t sides = 3 + random() % 3;
    std::vector<Dart> ring;
    for (std::size_t n = 0; n < 2 * sides; ++n) ring.push_back(edit.add_dart());
    for (std::size_t n = 0; n < 2 * sides; ++n)
      edit.link(n % 2 == 0 ? 0 : 1, ring[n], ring[(n + 1) % ring.size()]);
  }

  void change() {
    MapEdit edit(map, &journal);
    switch (map.dart_count() < 100 ? 0 : random() % 12) {
    case 0:
      return add_face();
    case 1:
      return remove_orbit(edit, FaceOfVolume, any());
    case 2:
    case 3:
    case 4:
      return static_cast<void>(unsew(edit, static_cast<int>(random() % 4), any()));
    default:
      return static_cast<void>(sew(edit, static_cast<int>(random() % 4), any(), any()));
    }
  }

  std::mt19937 random;
  GMap map{3};
  Journal journal;
};

TEST(CellIndex, numbers_orbits_by_their_smallest_dart) {
  const auto body = assets::grid(3, 2);
  const CellIndex cells(body->map(), Vertex);
  expect_sound(body->map(), cells);
  Dart last{0u};
  for (Slot s = 0; s < cells.slots(); ++s) {
    EXPECT_LE(last, cells.first_dart(s));
    last = cells.first_dart(s);
  }
}

TEST(CellIndex, stays_sound_in_a_storm_of_edits_for_every_orbit) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    CellStorm storm(seed);
    std::vector<CellIndex> indices;
    for (int mask = 0; mask < orbit_kinds; ++mask) indices.emplace_back(storm.map, orbit_of(mask));
    SlotEvents events;
    for (int round = 0; round < 120; ++round) {
      storm.journal.clear();
      for (unsigned n = 0; n <= storm.random() % 6; ++n) storm.change();
      for (CellIndex& cells : indices) {
        const std::size_t before = cells.count();
        cells.update(storm.map, storm.journal, events);
        SCOPED_TRACE(std::string(name(cells.orbit())) + " in round " + std::to_string(round));
        expect_sound(storm.map, cells);
        EXPECT_EQ(cells.count() + events.deaths.size(), before + events.births.size() + events.splits.size());
        for (auto [kept, absorbed] : events.merges) {
          EXPECT_TRUE(std::count(events.deaths.begin(), events.deaths.end(), absorbed))
              << "it lives on elsewhere";
          EXPECT_TRUE(cells.alive(kept));
        }
        if (testing::Test::HasFatalFailure()) return;
      }
    }
  }
}

TEST(CellIndex, an_orbit_that_keeps_its_darts_keeps_its_slot_and_moved_names_all_others) {
  CellStorm storm(7);
  for (int n = 0; n < 30; ++n) storm.add_face();
  std::vector<CellIndex> indices;
  for (int mask = 0; mask < orbit_kinds; ++mask) indices.emplace_back(storm.map, orbit_of(mask));
  SlotEvents events;
  for (int round = 0; round < 100; ++round) {
    storm.journal.clear();
    std::vector<std::map<Slot, std::vector<Dart>>> before;
    for (const CellIndex& cells : indices) before.push_back(orbits(storm.map, cells));
    for (int n = 0; n < 4; ++n) storm.change();
    const std::set<Dart> created(storm.journal.created.begin(), storm.journal.created.end());
    for (std::size_t mask = 0; mask < indices.size(); ++mask) {
      indices[mask].update(storm.map, storm.journal, events);
      std::map<Dart, Slot> old;
      std::map<std::vector<Dart>, Slot> slot_of_orbit;
      for (const auto& [slot, darts] : before[mask]) {
        slot_of_orbit[darts] = slot;
        for (Dart d : darts) old[d] = slot;
      }
      for (const auto& [slot, darts] : orbits(storm.map, indices[mask])) {
        const auto same = slot_of_orbit.find(darts);
        const bool is_new =
            std::any_of(darts.begin(), darts.end(), [&](Dart d) { return created.count(d) == 1; });
        if (same != slot_of_orbit.end() && !is_new) {
          EXPECT_EQ(slot, same->second);
        }
      }
      const std::set<Dart> moved(events.moved.begin(), events.moved.end());
      EXPECT_EQ(moved.size(), events.moved.size()) << "a dart moves once";
      storm.map.for_each_dart([&](Dart d) {
        const bool is_new = created.count(d) == 1;
        EXPECT_EQ(moved.count(d) == 1, is_new || old.at(d) != indices[mask].slot(d)) << "dart " << d.value;
      });
    }
  }
}

TEST(CellIndex, the_fragment_with_the_smallest_dart_keeps_the_slot) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const auto body = assets::random_sewing(seed, 10, 400);
    GMap map = body->map();
    std::vector<CellIndex> indices;
    for (int mask = 0; mask < orbit_kinds; ++mask) indices.emplace_back(map, orbit_of(mask));
    Journal journal;
    MapEdit edit(map, &journal);
    std::mt19937 random(seed);
    for (int n = 0; n < 10; ++n) unsew(edit, 2, Dart{random() % map.capacity()});
    for (CellIndex& cells : indices) {
      const auto before = orbits(map, cells);
      SlotEvents events;
      cells.update(map, journal, events);
      EXPECT_TRUE(events.merges.empty() && events.births.empty() && events.deaths.empty());
      std::set<Slot> fresh;
      for (auto [whole, fragment] : events.splits) {
        EXPECT_TRUE(fresh.insert(fragment).second);
        EXPECT_EQ(before.count(fragment), 0u);
        const std::vector<Dart>& darts = before.at(whole);
        EXPECT_TRUE(std::count(darts.begin(), darts.end(), cells.first_dart(fragment)));
      }
      for (const auto& [slot, darts] : before) EXPECT_EQ(cells.slot(darts.front()), slot);
    }
  }
}

TEST(CellIndex, what_becomes_one_keeps_the_slot_of_its_smallest_dart) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const auto body = assets::random_sewing(seed, 12, 20);
    GMap map = body->map();
    std::vector<CellIndex> indices;
    for (int mask = 0; mask < orbit_kinds; ++mask) indices.emplace_back(map, orbit_of(mask));
    Journal journal;
    MapEdit edit(map, &journal);
    std::mt19937 random(seed);
    for (int n = 0; n < 100; ++n)
      sew(edit, 2, Dart{random() % map.capacity()}, Dart{random() % map.capacity()});
    for (CellIndex& cells : indices) {
      const auto before = orbits(map, cells);
      SlotEvents events;
      cells.update(map, journal, events);
      EXPECT_TRUE(events.splits.empty() && events.births.empty());
      EXPECT_EQ(events.merges.size(), events.deaths.size());
      for (auto [kept, absorbed] : events.merges) {
        EXPECT_EQ(cells.slot(before.at(absorbed).front()), kept);
        EXPECT_LT(before.at(kept).front(), before.at(absorbed).front());
        EXPECT_FALSE(cells.alive(absorbed));
      }
    }
  }
}

// Three quads in a row, of which two are sewn. The edit unsews the middle quad from the one and sews it to the
// other.
void expect_that_the_middle_changes_sides(bool from_the_first) {
  GMap map(2);
  Journal journal;
  MapEdit edit(map, &journal);
  std::array<std::vector<Dart>, 3> quads;
  for (auto& ring : quads) {
    for (int n = 0; n < 8; ++n) ring.push_back(edit.add_dart());
    for (std::size_t n = 0; n < 8; ++n) edit.link(n % 2 == 0 ? 0 : 1, ring[n], ring[(n + 1) % 8]);
  }
  const auto join_first = [&] { ASSERT_TRUE(sew(edit, 2, quads[0][2], quads[1][7])); };
  const auto join_last = [&] { ASSERT_TRUE(sew(edit, 2, quads[1][2], quads[2][7])); };
  from_the_first ? join_first() : join_last();
  CellIndex cells(map, Component);
  journal.clear();
  ASSERT_TRUE(unsew(edit, 2, from_the_first ? quads[0][2] : quads[2][7]));
  from_the_first ? join_last() : join_first();
  SlotEvents events;
  cells.update(map, journal, events);
  expect_sound(map, cells);
  EXPECT_TRUE(events.splits.empty() && events.merges.empty() && events.births.empty() && events.deaths.empty());
  EXPECT_EQ(cells.slot(quads[0][0]), 0u);
  EXPECT_EQ(cells.slot(quads[1][0]), from_the_first ? 1u : 0u);
  EXPECT_EQ(cells.slot(quads[2][0]), 1u);
  EXPECT_TRUE(std::is_permutation(events.moved.begin(), events.moved.end(), quads[1].begin(), quads[1].end()));
}

TEST(CellIndex, a_part_that_changes_sides_moves_and_both_slots_stay) {
  expect_that_the_middle_changes_sides(true);
  expect_that_the_middle_changes_sides(false);
}

TEST(CellIndex, freed_slots_are_used_again_the_last_first) {
  EmbeddedMap body(2);
  const Dart a = assets::add_quad(body, 0, 0), b = assets::add_quad(body, 5, 0);
  const CellIndex& faces = body.use(FaceOfVolume);
  EXPECT_EQ(faces.slot(b), 1u);
  apply(rule("remove-isolated-face"), body, a);
  apply(rule("remove-isolated-face"), body, b);
  EXPECT_EQ(faces.count(), 0u);
  EXPECT_EQ(faces.slot(assets::add_quad(body, 0, 0)), 1u);
  EXPECT_EQ(faces.slot(assets::add_quad(body, 0, 0)), 0u);
  EXPECT_EQ(faces.slots(), 2u);
}

TEST(CellIndex, a_dart_removed_and_used_again_in_one_edit_is_a_new_one) {
  EmbeddedMap body(2);
  const Dart a = assets::add_quad(body, 0, 0);
  body.use(FaceOfVolume);
  body.edit([&](Edit& edit) {
    assets::remove_element(edit, a);
    apply(rule("create-triangle"), edit, {},
          assets::corners({assets::at(7, 0), assets::at(8, 0), assets::at(7, 1)}));
  });
  EXPECT_FALSE(validate(body));
  EXPECT_EQ(count_cells(body.map(), Vertex), 3u);
  body.map().for_each_dart([&](Dart d) { EXPECT_GE(body.position_of(d).x(), 7); });
}

} // namespace
} // namespace rend::cell_index_test
