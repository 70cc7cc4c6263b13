#include "sim/embedding/embedded_map.h"

#include "sim/base/check.h"
#include "tests/sim/assets.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace rend::embedded_map_test {
namespace {

Dart find_edge(const EmbeddedMap& body, const Vec3& from, const Vec3& to) {
  for (Dart d : assets::all_darts(body.map()))
    if (body.position_of(d) == from && body.position_of(body.map().alpha(0, d)) == to) return d;
  ADD_FAILURE() << "no such edge";
  return {};
}

TEST(EmbeddedMap, every_asset_is_valid_with_all_orbits_in_use) {
  for (const auto& asset : assets::all()) {
    const auto body = asset.make();
    for (int mask = 0; mask < orbit_kinds; ++mask) {
      Orbit orbit;
      orbit.mask = static_cast<std::uint8_t>(mask);
      body->use(orbit);
    }
    const auto fault = validate(*body);
    EXPECT_FALSE(fault) << asset.name << ": " << fault.value_or("");
  }
}

TEST(EmbeddedMap, separating_one_edge_inside_a_sheet_splits_no_vertex) {
  const auto body = assets::grid(3, 3);
  const CellIndex& vertices = body->cells(Vertex);
  apply(rule("unsew-edge"), *body, find_edge(*body, Vec3(1, 1, 0), Vec3(2, 1, 0)));
  EXPECT_EQ(vertices.count(), 16u);
  // Separating the next edge at the same vertex splits it, ...
  apply(rule("unsew-edge"), *body, find_edge(*body, Vec3(2, 1, 0), Vec3(2, 2, 0)));
  EXPECT_EQ(vertices.count(), 17u);
  // ... and an edge that ends at the border splits both its end points.
  apply(rule("unsew-edge"), *body, find_edge(*body, Vec3(1, 1, 0), Vec3(0, 1, 0)));
  EXPECT_EQ(vertices.count(), 19u);
  EXPECT_FALSE(validate(*body));
}

TEST(EmbeddedMap, every_dart_keeps_its_position_and_velocity_through_a_separation) {
  const auto body = assets::grid(3, 3);
  std::vector<Vec3> velocity(body->map().capacity()), position(body->map().capacity());
  for (Slot v = 0; v < body->velocity().values().size(); ++v) body->velocity()[v] = Record(v, 2.0 * v, 1);
  for (Dart d : assets::all_darts(body->map())) {
    velocity[d.value] = body->velocity()[body->vertex(d)];
    position[d.value] = body->position_of(d);
  }
  body->edit([](Edit& edit) {
    for (Dart d : assets::all_darts(edit.map())) unsew(edit, 2, d);
  });
  EXPECT_EQ(body->cells(Vertex).count(), 36u);
  for (Dart d : assets::all_darts(body->map())) {
    EXPECT_EQ(Vec3(body->velocity()[body->vertex(d)]), velocity[d.value]);
    EXPECT_EQ(body->position_of(d), position[d.value]);
  }
}

TEST(EmbeddedMap, a_new_vertex_without_a_point_is_our_slip) {
  EmbeddedMap body(2);
  EXPECT_THROW(body.edit([](Edit& edit) { edit.add_dart(); }), InternalError);
}

TEST(EmbeddedMap, any_dart_of_a_new_vertex_may_be_given_its_point) {
  EmbeddedMap body(2);
  Dart a, b;
  body.edit([&](Edit& edit) {
    a = edit.add_dart();
    b = edit.add_dart();
    edit.link(1, a, b);
    edit.give(b, assets::at(3, 4));
  });
  EXPECT_EQ(body.position_of(a), Vec3(3, 4, 0));
  EXPECT_EQ(body.vertex(a), body.vertex(b));
}

TEST(EmbeddedMap, a_point_given_to_a_vertex_that_is_there_changes_nothing) {
  const auto body = assets::single_quad();
  body->edit([](Edit& edit) {
    edit.give(Dart{0u}, assets::at(9, 9));
    unsew(edit, 1, Dart{0u});
  });
  EXPECT_EQ(body->position_of(Dart{0u}), Vec3(0, 0, 0));
}

TEST(EmbeddedMap, a_map_built_in_bulk_asks_once_for_each_vertex) {
  GMap map(3);
  MapEdit edit(map);
  std::vector<Vec3> place;
  assets::add_cube(edit, place, Vec3::Zero());
  std::vector<Dart> asked;
  const EmbeddedMap body(std::move(map), [&](Dart d) {
    asked.push_back(d);
    return assets::at(place[d.value].x(), place[d.value].y(), place[d.value].z());
  });
  EXPECT_EQ(asked.size(), 8u);
  for (Dart d : asked) EXPECT_EQ(smallest_dart(body.map(), Vertex, d), d);
  for (Dart d : assets::all_darts(body.map())) EXPECT_EQ(body.position_of(d), place[d.value]);
}

TEST(EmbeddedMap, readers_are_told_which_darts_and_slots_an_edit_changed) {
  const auto body = assets::grid(2, 1);
  body->use(FaceOfVolume);
  Changes changes;
  body->subscribe(changes);
  const Dart d = find_edge(*body, Vec3(1, 0, 0), Vec3(1, 1, 0));
  const std::vector<Dart> edge = darts_of(body->map(), EdgeOfVolume, d);
  std::vector<Slot> before(body->map().capacity());
  for (Dart e : assets::all_darts(body->map())) before[e.value] = body->vertex(e);
  apply(rule("unsew-edge"), *body, d);
  EXPECT_TRUE(changes.any);
  EXPECT_TRUE(
      std::is_permutation(edge.begin(), edge.end(), changes.touched[2].begin(), changes.touched[2].end()));
  for (Dart e : assets::all_darts(body->map())) {
    const auto& moved = changes.moved[Vertex.mask];
    EXPECT_EQ(before[e.value] != body->vertex(e), std::count(moved.begin(), moved.end(), e) == 1);
  }
  EXPECT_EQ(changes.slots[Vertex.mask].size(), 4u); // two splits: the remaining part and the fragment
  EXPECT_TRUE(changes.moved[FaceOfVolume.mask].empty());
  changes.clear();
  body->unsubscribe(changes);
  apply(rule("unsew-edge"), *body, Dart{0u});
  EXPECT_FALSE(changes.any);
}

TEST(EmbeddedMap, an_edit_that_changes_nothing_reports_no_changes) {
  const auto body = assets::grid(2, 1);
  Changes changes;
  body->subscribe(changes);
  body->edit([](Edit&) {});
  EXPECT_FALSE(apply(rule("unsew-edge"), *body, Dart{0u}).ok);
  EXPECT_FALSE(changes.any);
}

TEST(EmbeddedMap, many_changes_in_one_edit_leave_the_points_that_single_edits_leave) {
  const auto one = assets::grid(3, 3), many = assets::grid(3, 3);
  std::vector<Dart> faces;
  for (Dart d : assets::all_darts(one->map()))
    if (smallest_dart(one->map(), FaceOfVolume, d) == d) faces.push_back(d);
  for (Dart d : faces) {
    apply(rule("star-face"), *many, d);
    apply(rule("insert-vertex"), *many, d);
    apply(rule("star-face"), *many, d);
  }
  one->edit([&](Edit& edit) {
    for (Dart d : faces) {
      EXPECT_TRUE(apply(rule("star-face"), edit, d).ok);
      EXPECT_TRUE(apply(rule("insert-vertex"), edit, d).ok);
      EXPECT_TRUE(apply(rule("star-face"), edit, d).ok);
    }
  });
  EXPECT_FALSE(validate(*one));
  EXPECT_EQ(assets::links(one->map()), assets::links(many->map()));
  for (Dart d : assets::all_darts(one->map())) EXPECT_EQ(one->position_of(d), many->position_of(d));
}

TEST(EmbeddedMap, what_was_created_can_be_cut_off_in_the_same_edit) {
  const auto body = assets::single_quad();
  body->edit([](Edit& edit) {
    apply(rule("star-face"), edit, Dart{0u});
    for (Dart d : assets::all_darts(edit.map()))
      for (int i : {2, 1}) unsew(edit, i, d);
  });
  EXPECT_FALSE(validate(*body));
  for (Dart d : assets::all_darts(body->map())) {
    const Vec3 p = body->position_of(d);
    EXPECT_TRUE(p == Vec3(0.5, 0.5, 0) || (p - Vec3(0.5, 0.5, 0)).norm() == std::sqrt(0.5));
  }
}

} // namespace
} // namespace rend::embedded_map_test
