// What MapEdit takes back, against copies from before.
#include "sim/base/archive.h"
#include "sim/topology/map_edit.h"
#include "sim/topology/validate.h"
#include "tests/sim/assets.h"

#include <gtest/gtest.h>

#include <random>

namespace rend::undo_test {
namespace {

// Links of all darts, capacity, and the list of free darts with its order.
std::vector<std::uint8_t> bytes_of(GMap map) {
  Archive archive;
  map.store(archive);
  return archive.bytes();
}

void expect_equal(const Journal& a, const Journal& b) {
  EXPECT_EQ(a.touched, b.touched);
  EXPECT_EQ(a.created, b.created);
  EXPECT_EQ(a.removed, b.removed);
}

// Any change that the map allows: legal for the axioms or not, single links and whole orbits.
struct Storm {
  explicit Storm(unsigned seed, int dimension) : random(seed), map(dimension) {}

  Dart any() {
    const std::vector<Dart> darts = assets::all_darts(map);
    return darts.empty() ? Dart{} : darts[random() % darts.size()];
  }

  void change(MapEdit& edit) {
    const std::size_t what = map.dart_count() < 8 ? 0 : random() % 16;
    const int i = static_cast<int>(random() % static_cast<unsigned>(map.dimension() + 1));
    const Dart a = any(), b = any();
    if (what < 4) return static_cast<void>(edit.add_dart());
    if (what < 7) return remove_orbit(edit, what < 6 ? SingleDart : FaceOfVolume, a);
    if (what < 10) return static_cast<void>(unsew(edit, i, a));
    if (what < 13) return static_cast<void>(sew(edit, i, a, b));
    if (!map.is_free(i, a)) return edit.unlink(i, a);
    if (map.is_free(i, b)) edit.link(i, a, b);
  }

  std::mt19937 random;
  GMap map;
  Journal journal;
};

TEST(Undo, leaves_links_free_darts_and_journal_as_at_the_savepoint) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    Storm storm(seed, seed % 2 == 0 ? 2 : 3);
    MapEdit edit(storm.map, &storm.journal);
    for (std::size_t n = storm.random() % 60; n > 0; --n) storm.change(edit);
    for (int round = 0; round < 20; ++round) {
      const auto before = bytes_of(storm.map);
      const Journal was = storm.journal;
      const MapEdit::Savepoint start = edit.savepoint();
      for (std::size_t n = storm.random() % 40; n > 0; --n) storm.change(edit);
      edit.rollback(start);
      ASSERT_EQ(bytes_of(storm.map), before) << "seed " << seed << ", round " << round;
      expect_equal(storm.journal, was);
      for (std::size_t n = storm.random() % 5; n > 0; --n) storm.change(edit); // the map goes on
    }
  }
}

TEST(Undo, goes_back_through_savepoints_one_after_another) {
  Storm storm(5, 3);
  MapEdit edit(storm.map, &storm.journal);
  std::vector<std::pair<MapEdit::Savepoint, std::vector<std::uint8_t>>> all;
  for (int n = 0; n < 400; ++n) {
    all.emplace_back(edit.savepoint(), bytes_of(storm.map));
    storm.change(edit);
  }
  while (!all.empty()) {
    edit.rollback(all.back().first);
    ASSERT_EQ(bytes_of(storm.map), all.back().second) << all.size();
    const std::size_t skipped = std::min<std::size_t>(all.size(), 1 + storm.random() % 3);
    all.resize(all.size() - skipped);
  }
  EXPECT_TRUE(storm.journal.empty());
}

TEST(Undo, does_not_change_what_follows) {
  Storm one(9, 2), other(9, 2);
  MapEdit edit(one.map, &one.journal), straight(other.map, &other.journal);
  for (int n = 0; n < 200; ++n) {
    const std::mt19937 random = one.random;
    const MapEdit::Savepoint start = edit.savepoint();
    for (int k = 0; k < 10; ++k) one.change(edit);
    edit.rollback(start);
    one.random = random;
    one.change(edit);
    other.change(straight);
  }
  EXPECT_EQ(bytes_of(one.map), bytes_of(other.map));
  expect_equal(one.journal, other.journal);
}

TEST(Undo, of_a_rule_takes_back_what_it_created) {
  for (const auto& asset : assets::all()) {
    const auto body = asset.make();
    GMap map = body->map();
    const auto before = bytes_of(map);
    Journal journal;
    MapEdit edit(map, &journal);
    const MapEdit::Savepoint start = edit.savepoint();
    for (const Dart d : assets::all_darts(map))
      for (int i = 0; i < 4; ++i) unsew(edit, i, d);
    for (const Dart d : assets::all_darts(map)) edit.remove_dart(d);
    for (int n = 0; n < 100; ++n) edit.add_dart();
    edit.rollback(start);
    EXPECT_EQ(bytes_of(map), before) << asset.name;
  }
}

} // namespace
} // namespace rend::undo_test
