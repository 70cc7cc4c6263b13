#include "sim/topology/map_edit.h"

#include "sim/base/check.h"
#include "sim/topology/validate.h"
#include "tests/sim/assets.h"

#include <gtest/gtest.h>

namespace rend::map_edit_test {
namespace {

// A face of n sides with its darts in order.
std::vector<Dart> polygon(MapEdit& edit, std::size_t n) {
  std::vector<Dart> darts;
  for (std::size_t k = 0; k < 2 * n; ++k) darts.push_back(edit.add_dart());
  for (std::size_t k = 0; k < 2 * n; ++k) edit.link(k % 2 == 0 ? 0 : 1, darts[k], darts[(k + 1) % (2 * n)]);
  return darts;
}

TEST(MapEdit, a_removed_dart_is_the_next_to_be_used_again) {
  GMap map(2);
  MapEdit edit(map);
  const Dart a = edit.add_dart(), b = edit.add_dart();
  edit.remove_dart(a);
  EXPECT_FALSE(map.alive(a));
  EXPECT_EQ(map.dart_count(), 1u);
  EXPECT_EQ(edit.add_dart(), a);
  EXPECT_TRUE(map.alive(b));
}

TEST(MapEdit, refuses_what_would_break_a_link) {
  GMap map(2);
  MapEdit edit(map);
  const Dart a = edit.add_dart(), b = edit.add_dart(), c = edit.add_dart();
  edit.link(0, a, b);
  EXPECT_THROW(edit.link(0, a, c), InternalError);
  EXPECT_THROW(edit.unlink(0, c), InternalError);
  EXPECT_THROW(edit.remove_dart(a), InternalError);
  EXPECT_THROW(edit.link(3, a, b), InternalError); // the map has dimension 2
}

TEST(MapEdit, the_journal_names_every_dart_whose_link_changed) {
  GMap map(2);
  Journal journal;
  MapEdit edit(map, &journal);
  const Dart a = edit.add_dart(), b = edit.add_dart();
  edit.link(0, a, b);
  edit.unlink(0, b);
  edit.remove_dart(a);
  EXPECT_EQ(journal.created, (std::vector{a, b}));
  EXPECT_EQ(journal.touched[0], (std::vector{a, b, b, a}));
  EXPECT_EQ(journal.removed, (std::vector{a}));
  journal.clear();
  EXPECT_TRUE(journal.empty());
}

TEST(Sew, keeps_the_axioms_in_every_dimension) {
  GMap map(3);
  MapEdit edit(map);
  const Dart a = edit.add_dart(), b = edit.add_dart(), c = edit.add_dart();
  EXPECT_TRUE(sew(edit, 0, a, b));
  EXPECT_TRUE(sew(edit, 1, b, c));
  EXPECT_FALSE(validate(map));
  const auto first = polygon(edit, 4), second = polygon(edit, 4);
  EXPECT_TRUE(sew(edit, 2, first[0], second[0]));
  EXPECT_EQ(map.alpha(2, first[1]), second[1]);
  EXPECT_FALSE(validate(map));
  std::vector<Vec3> place;
  const auto one = assets::add_cube(edit, place, Vec3(0, 0, 0)),
             two = assets::add_cube(edit, place, Vec3(1, 0, 0));
  EXPECT_TRUE(sew(edit, 3, one[1], two[0]));
  for (Dart d : darts_of(map, FaceOfVolume, one[1])) EXPECT_FALSE(map.is_free(3, d));
  EXPECT_FALSE(validate(map));
}

TEST(Sew, unsewing_undoes_it) {
  const auto body = assets::row_of_cubes(2);
  const auto before = assets::links(body->map());
  for (Dart d : assets::all_darts(body->map())) {
    for (int i = 0; i < 4; ++i) {
      const Dart other = body->map().alpha(i, d);
      bool open = false;
      body->edit([&](Edit& edit) { open = unsew(edit, i, d); });
      EXPECT_EQ(open, d != other);
      EXPECT_FALSE(validate(body->map()));
      if (open) body->edit([&](Edit& edit) { EXPECT_TRUE(sew(edit, i, d, other)); });
      EXPECT_EQ(assets::links(body->map()), before);
    }
  }
}

TEST(Sew, refuses_and_changes_nothing_where_a_link_is_taken_or_the_orbits_differ) {
  GMap map(3);
  MapEdit edit(map);
  const auto quad = polygon(edit, 4), triangle = polygon(edit, 3), other = polygon(edit, 4);
  ASSERT_TRUE(sew(edit, 2, quad[0], other[0]));
  const auto before = assets::links(map);
  EXPECT_FALSE(sew(edit, 3, quad[0], triangle[0])); // four sides and three
  EXPECT_FALSE(sew(edit, 2, quad[0], triangle[0])); // not free
  EXPECT_FALSE(sew(edit, 2, quad[2], quad[2]));     // a dart to itself
  EXPECT_FALSE(sew(edit, 3, quad[0], quad[2]));     // a face to itself, shifted: not an involution
  EXPECT_FALSE(unsew(edit, 3, quad[0]));
  EXPECT_EQ(assets::links(map), before);
  GMap sheet(2);
  MapEdit flat(sheet);
  const auto a = polygon(flat, 4), b = polygon(flat, 4);
  EXPECT_FALSE(sew(flat, 3, a[0], b[0]));
}

TEST(Sew, an_edge_can_be_folded_onto_itself) {
  GMap map(2);
  MapEdit edit(map);
  const auto quad = polygon(edit, 4);
  EXPECT_TRUE(sew(edit, 2, quad[0], quad[1]));
  EXPECT_EQ(map.alpha(2, quad[0]), quad[1]);
  EXPECT_FALSE(validate(map));
  EXPECT_EQ(count_cells(map, Vertex), 3u);
}

TEST(RemoveOrbit, leaves_the_neighbours_free) {
  const auto body = assets::row_of_cubes(2);
  body->edit([](Edit& edit) { remove_orbit(edit, Volume, Dart{0u}); });
  EXPECT_FALSE(validate(*body));
  const CellCounts counts = count_cells(body->map());
  EXPECT_EQ(counts.volumes, 1u);
  EXPECT_EQ(counts.vertices, 8u);
}

} // namespace
} // namespace rend::map_edit_test
