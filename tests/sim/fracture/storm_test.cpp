// Stress tests: all changes at random cells, on every kind of mesh. The map stays valid; no vertex moves; all
// that depends on the map equals what is built from scratch; and fragments are counted correctly after each
// change.
#include "sim/fracture/torn_bodies.h"
#include "sim/fracture/torn_checks.h"

#include <gtest/gtest.h>

namespace rend::storm_test {
namespace {

using namespace torn;

// Every change on every kind of cell, but for cuts, which need a law of their own (cut_test.cpp).
const std::vector<RandomChange>& every_change() {
  static const std::vector<RandomChange> all = [] {
    std::vector<RandomChange> out;
    for (const ChangeType& type : all_changes()) {
      if (type.of_law) continue;
      for (Cell cell : {Cell::Edges, Cell::Borders, Cell::Vertices, Cell::Elements})
        out.push_back({type.name, cell});
    }
    return out;
  }();
  return all;
}

bool deletes(const std::string& change) {
  return change.starts_with("delete");
}

void apply_random_edits(Body& body, int steps) {
  Seen seen(body);
  for (int n = 0; n < steps; ++n) {
    const Snapshot before(body);
    const std::size_t events = body.events.size();
    body.evaluate();
    body.tear(n, n, [] {});
    bool deleted = false;
    for (std::size_t e = events; e < body.events.size(); ++e)
      deleted |= deletes(body.tear_laws[static_cast<std::size_t>(body.events[e].law)].settings().change->name);
    expect_nothing_moved(body, before, deleted);
    if (n % 3 == 0) continue; // sometimes two changes before an update
    seen.update();
    expect_as_built_anew(body, seen);
    if (testing::Test::HasFailure()) FAIL() << "after step " << n;
  }
}

TEST(Storm, of_each_change_on_every_mesh_leaves_a_valid_map_and_moves_nothing) {
  for (const RandomChange& way : every_change()) {
    for (auto& each : elements::irregular_maps()) {
      SCOPED_TRACE(way.change + " on " + each.name);
      const auto body = torn::body(std::move(each.map), {way}, "symplectic", true);
      apply_random_edits(*body, 25);
      EXPECT_GT(body->events.size(), 5u);
    }
  }
}

TEST(Storm, of_all_laws_at_once_leaves_a_valid_map_and_moves_nothing) {
  for (auto& each : elements::irregular_maps()) {
    SCOPED_TRACE(each.name);
    // full binding and rebinding of both sets of rows
    const auto body = torn::body(std::move(each.map), every_change(), "rk4", true);
    apply_random_edits(*body, 25);
    EXPECT_GT(body->events.size(), 5u);
  }
}

TEST(Storm, on_sheets_of_many_sides_and_without_sides_leaves_a_valid_map) {
  for (const meshes::Named& each : meshes::irregular()) {
    SCOPED_TRACE(each.name);
    const auto body = torn::body(sheet_from(each.mesh), every_change());
    apply_random_edits(*body, 20);
  }
}

TEST(FragmentCounter, are_those_of_making_one_change_after_the_other_and_counting) {
  for (const RandomChange& way : every_change()) {
    // Places elsewhere are found on the map before all changes: changes made one by one find others.
    if (change(way.change).cell != way.cell) continue;
    for (std::size_t m = 0; m < elements::irregular_maps().size(); ++m) {
      auto maps = elements::irregular_maps(), twins = elements::irregular_maps();
      SCOPED_TRACE(way.change + " on " + maps[m].name);
      const auto body = torn::body(std::move(maps[m].map), {way, {"separate", Cell::Borders}});
      const auto twin = torn::body(std::move(twins[m].map), {way});
      RandomCriterion<Cell::Borders>::most = 60; // many, so that pieces come off
      long most = 0;
      for (int step = 0; step < 8; ++step) {
        const std::size_t first = body->events.size();
        std::vector<Candidate> found;
        body->evaluate();
        body->tear(step, step, [] {});
        for (auto* some : {&RandomCriterion<Cell::Borders>::found, &RandomCriterion<Cell::Vertices>::found,
                           &RandomCriterion<Cell::Edges>::found, &RandomCriterion<Cell::Elements>::found}) {
          found.insert(found.end(), some->begin(), some->end());
          some->clear();
        }
        std::vector<std::vector<Dart>> cells; // cells of the events of one law, before its first change
        std::size_t noted = first;
        for (std::size_t e = first; e < body->events.size(); ++e) {
          const TearEvent& event = body->events[e];
          const RandomChange by = event.law == 0 ? way : RandomChange{"separate", Cell::Borders};
          if (noted == e) twin->evaluate(); // a law evaluates forces once, and then makes all its changes
          for (; noted < body->events.size() && body->events[noted].law == event.law; ++noted)
            cells.push_back(cell_of(*twin, by.cell, body->events[noted].dart));
          const auto candidate = std::find_if(found.begin(), found.end(), [&](const Candidate& c) {
            return c.dart == event.dart && c.value == event.value;
          });
          ASSERT_NE(candidate, found.end());
          const long before = static_cast<long>(count_cells(twin->map->map(), Component));
          ASSERT_TRUE(make(*twin, by.change, by.cell, *candidate, cells[e - first]));
          const long after = static_cast<long>(count_cells(twin->map->map(), Component));
          EXPECT_EQ(event.fragments, after);
          EXPECT_EQ(event.born, after - before);
          most = std::max(most, after);
        }
      }
      RandomCriterion<Cell::Borders>::most = 4;
      EXPECT_GT(most, 1);
    }
  }
}

TEST(Body, that_loses_its_last_element_goes_on_with_nothing) {
  for (const char* scheme : {"symplectic", "rk4", "implicit"}) {
    for (auto& each : elements::irregular_maps()) {
      SCOPED_TRACE(each.name + std::string(", ") + scheme);
      const auto body = torn::body(std::move(each.map),
                                   {{"delete-element", Cell::Elements}, {"delete-edge", Cell::Edges}}, scheme);
      RandomCriterion<Cell::Elements>::most = 20;
      Seen seen(*body);
      int step = 0;
      for (; !body->deleted_at && step < 400; ++step) {
        body->evaluate();
        body->tear(step * 1e-3, step, [] {});
      }
      RandomCriterion<Cell::Elements>::most = 4;
      ASSERT_TRUE(body->deleted_at);
      EXPECT_EQ(*body->deleted_at, (step - 1) * 1e-3);
      EXPECT_EQ(body->events.back().fragments, 0);
      EXPECT_EQ(body->map->map().dart_count(), 0u);
      EXPECT_EQ(total_mass(*body->map, *body->mass), 0);
      seen.update();
      expect_as_built_anew(*body, seen);
      for (int n = 0; n < 3; ++n) {
        body->evaluate();
        EXPECT_EQ(body->tear(1, step, [] {}), 0);
        body->advance(1, 1e-3);
        EXPECT_TRUE(body->next.finite());
        body->commit();
      }
      EXPECT_TRUE(body->constraints.vertices().empty());
    }
  }
}

} // namespace
} // namespace rend::storm_test
