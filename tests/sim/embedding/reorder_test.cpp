#include "sim/embedding/reorder.h"

#include "sim/mesh/bar.h"
#include "sim/topology/walk.h"
#include "tests/sim/assets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace rend::reorder_test {
namespace {

// The position of each dart, and a value at its corner.
struct Carried {
  using Value = std::uint32_t;
  std::string name = "who I am";
  Orbit orbit = VertexOfFace;
  Orbit support = SingleDart;
  Value birth(const EmbeddedMap& map, Dart d) const { return smallest_dart(map.map(), orbit, d).value; }
  Value split(const Value& whole) const { return whole; }
};

std::vector<Dart> inner_faces(const GMap& map) {
  std::vector<Dart> faces;
  map.for_each_dart([&](Dart d) {
    if (!map.is_free(3, d) && smallest_dart(map, Face, d) == d) faces.push_back(d);
  });
  return faces;
}

// Tetrahedra, with some faces separated one after another, at random.
std::unique_ptr<EmbeddedMap> crumbled(int n, double share, Changes* reader = nullptr) {
  auto body = solid_from(bar_cells({BarPattern::Tetrahedra, n, n, n, Vec3(1, 1, 1)}));
  body->add(Carried{});
  body->use(Volume);
  body->use(Face);
  if (reader) body->subscribe(*reader);
  std::vector<Dart> faces = inner_faces(body->map());
  std::shuffle(faces.begin(), faces.end(), std::mt19937(7));
  faces.resize(static_cast<std::size_t>(share * static_cast<double>(faces.size())));
  for (const Dart d : faces) body->edit([&](Edit& edit) { unsew(edit, 3, d); });
  return body;
}

void expect_numbered_as_if_built_now(const EmbeddedMap& body) {
  EXPECT_EQ(validate(body), std::nullopt);
  for (int mask = 0; mask < orbit_kinds; ++mask) {
    Orbit orbit;
    orbit.mask = static_cast<std::uint8_t>(mask);
    if (!body.uses(orbit)) continue;
    const CellIndex fresh(body.map(), orbit);
    ASSERT_EQ(body.cells(orbit).slots(), fresh.slots());
    body.map().for_each_dart([&](Dart d) { ASSERT_EQ(body.slot(orbit, d), fresh.slot(d)); });
  }
}

TEST(Reorder, gives_the_slots_of_a_map_built_now_and_every_dart_keeps_its_values) {
  Changes reader;
  const auto body = crumbled(3, 0.5, &reader);
  body->edit([&](Edit& edit) { // free slots before and after others
    for (const Dart first : {Dart{48u}, Dart{240u}}) {
      for (const Dart d : darts_of(edit.map(), Volume, first)) unsew(edit, 3, d);
      remove_orbit(edit, Volume, first);
    }
  });
  const auto& carried = static_cast<const Column<Carried>&>(*body->columns().back());
  std::vector<Vec3> places;
  std::vector<std::uint32_t> names;
  body->map().for_each_dart([&](Dart d) {
    places.push_back(body->position_of(d));
    names.push_back(carried[body->slot(VertexOfFace, d)]);
  });
  reader.clear();
  body->renumber();
  expect_numbered_as_if_built_now(*body);
  EXPECT_TRUE(reader.any && reader.whole);
  std::size_t n = 0;
  body->map().for_each_dart([&](Dart d) {
    ASSERT_EQ(body->position_of(d), places[n]);
    ASSERT_EQ(carried[body->slot(VertexOfFace, d)], names[n++]);
  });
  body->unsubscribe(reader);
}

TEST(Reorder, leaves_a_map_that_takes_further_edits) {
  const auto body = crumbled(3, 0.3);
  body->renumber();
  for (const Dart d : inner_faces(body->map())) body->edit([&](Edit& edit) { unsew(edit, 3, d); });
  EXPECT_EQ(validate(*body), std::nullopt);
  EXPECT_EQ(body->cells(Vertex).count(), 4u * body->cells(Volume).count());
}

TEST(Reorder, is_worth_while_where_most_vertices_are_new_and_lie_anywhere) {
  EXPECT_FALSE(slots_scattered(*crumbled(6, 0), 1));
  EXPECT_FALSE(slots_scattered(*crumbled(6, 0.1), 1));
  const auto body = crumbled(6, 0.7);
  EXPECT_TRUE(slots_scattered(*body, 1));
  EXPECT_FALSE(slots_scattered(*body)) << "it is small";
  body->renumber();
  EXPECT_FALSE(slots_scattered(*body, 1)) << "it is in order now";
}

} // namespace
} // namespace rend::reorder_test
