// The values of criteria, against their definitions computed from polygons (thesis 7.4).
#include "sim/brute_force.h"
#include "sim/house_rules/house_rules.h"
#include "sim/rules/apply.h"

#include <gtest/gtest.h>

namespace rend::criterion_test {
namespace {

using namespace meshes;

// A body with every interaction and both criteria, with its forces evaluated.
std::unique_ptr<Body> strained(const PolygonMesh& mesh, double threshold, const std::vector<Spring>& springs) {
  Recipe recipe;
  recipe.springs = springs;
  recipe.criteria = {"global-border", "atomic-border"};
  recipe.threshold = threshold;
  std::unique_ptr<Body> made = body(mesh, recipe);
  shake(*made, 0.2, 4);
  made->evaluate();
  return made;
}

// Both criteria give the polygons' values at all edges.
void expect_values_of(Body& body, const BruteForce& brute) {
  for (TearLaw& law : body.tear_laws) {
    const bool atomic = law.settings().criterion->elementary;
    const std::vector<Candidate> found = law.find(body.view());
    const std::map<Dart, double> expected = brute.border_values(*body.map, atomic);
    double most = 0;
    for (const auto& [dart, value] : expected) most = std::max(most, value);
    EXPECT_EQ(found.size(), expected.size());
    for (const Candidate& c : found) {
      ASSERT_TRUE(expected.contains(c.dart));
      EXPECT_NEAR(c.value, expected.at(c.dart), 1e-12 * most);
    }
  }
}

TEST(Criterion, measures_on_every_sheet_what_its_definition_says) {
  for (const Named& sheet : irregular()) {
    SCOPED_TRACE(sheet.name);
    const auto body = strained(sheet.mesh, 1e-9, all_springs(0.5));
    BruteForce brute(sheet.mesh);
    brute.look_at(*body);
    for (const Spring& spring : all_springs(0.5)) brute.add(spring);
    expect_values_of(*body, brute);
  }
}

TEST(Criterion, measures_by_each_interaction_alone_what_its_definition_says) {
  for (const Named& sheet : irregular()) {
    for (const Spring& spring : all_springs(0.5)) {
      SCOPED_TRACE(spring.element + " " + spring.kind + " on " + sheet.name);
      const auto body = strained(sheet.mesh, 1e-12, {spring});
      if (body->interactions.empty()) continue;
      BruteForce brute(sheet.mesh);
      brute.look_at(*body);
      brute.add(spring);
      for (TearLaw& law : body->tear_laws) {
        const auto expected = brute.border_values(*body->map, law.settings().criterion->elementary);
        for (const Candidate& c : law.find(body->view())) EXPECT_NEAR(c.value, expected.at(c.dart), 1e-11);
      }
    }
  }
}

TEST(Criterion, measures_on_torn_sheets_what_its_definition_says) {
  for (const Named& sheet : irregular()) {
    SCOPED_TRACE(sheet.name);
    const auto body = strained(sheet.mesh, 1e-9, all_springs(0.5));
    Noise noise(2);
    const std::size_t darts = body->map->map().capacity();
    for (int n = 0; n < 25; ++n) {
      body->map->edit([&](Edit& edit) { unsew(edit, 2, Dart{noise.below(darts)}); });
      body->rebind();
    }
    shake(*body, 0.2, 6);
    body->evaluate();
    BruteForce brute(*body->map);
    brute.look_at(*body);
    for (const Spring& spring : all_springs(0.5)) brute.add(spring);
    expect_values_of(*body, brute);
  }
}

TEST(Criterion, does_not_depend_on_which_way_round_the_faces_are_walked) {
  PolygonMesh mesh = warped(sheet(SheetPattern::Mixed, 4, 3), 0.2, 5);
  const auto one = strained(mesh, 1e-9, all_springs());
  for (std::size_t p = 0; p < mesh.polygons(); p += 2) // every second face with opposite orientation
    std::reverse(mesh.corners.begin() + mesh.first[p] + 1, mesh.corners.begin() + mesh.first[p + 1]);
  const auto two = strained(mesh, 1e-9, all_springs());
  // Slots differ, so the same state is assigned by position.
  for (Slot v = 0; v < two->program->vertices(); ++v)
    for (Slot w = 0; w < one->program->vertices(); ++w)
      if (one->map->rest()[w].vec() == two->map->rest()[v].vec()) {
        two->map->position()[v] = one->map->position()[w];
        two->map->velocity()[v] = one->map->velocity()[w];
      }
  two->evaluate();
  for (std::size_t n = 0; n < 2; ++n) {
    const auto a = one->tear_laws[n].find(one->view()), b = two->tear_laws[n].find(two->view());
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t c = 0; c < a.size(); ++c) EXPECT_NEAR(a[c].value, b[c].value, 1e-11 * a[0].value);
  }
}

TEST(ForceLaw, finds_what_exceeds_the_threshold_by_falling_value) {
  const auto body = strained(warped(sheet(SheetPattern::Quads, 5, 5), 0.2, 8), 20, all_springs());
  BruteForce brute(*body->map);
  brute.look_at(*body);
  for (const Spring& spring : all_springs()) brute.add(spring);
  for (TearLaw& law : body->tear_laws) {
    const std::vector<Candidate> found = law.find(body->view());
    const auto all = brute.border_values(*body->map, law.settings().criterion->elementary);
    const auto above = std::count_if(all.begin(), all.end(), [](const auto& v) { return v.second > 20; });
    EXPECT_EQ(found.size(), static_cast<std::size_t>(above));
    EXPECT_GT(found.size(), 3u);
    EXPECT_LT(found.size(), all.size());
    for (std::size_t n = 1; n < found.size(); ++n) EXPECT_GE(found[n - 1].value, found[n].value);
  }
}

TEST(ForceLaw, breaks_ties_by_the_smallest_dart) {
  Recipe recipe;
  recipe.springs = {{"stretch", "", 60, 0}};
  recipe.criteria = {"global-border"};
  recipe.threshold = 1e-3;
  const auto body = meshes::body(sheet(SheetPattern::Quads, 4, 4), recipe);
  for (Slot v = 0; v < body->program->vertices(); ++v) // the middle column is displaced symmetrically
    if (body->map->rest()[v].x == 2) body->map->position()[v].x = 2.5;
  body->evaluate();
  const ForceView view = body->view();
  const std::vector<Candidate> found = body->tear_laws[0].find(view);
  int ties = 0;
  for (std::size_t n = 1; n < found.size(); ++n) {
    EXPECT_GE(found[n - 1].value, found[n].value);
    if (found[n - 1].value != found[n].value) continue;
    EXPECT_LT(found[n - 1].dart, found[n].dart);
    ++ties;
  }
  EXPECT_GT(ties, 0);
}

TEST(ForceLaw, makes_at_most_so_many_changes_a_step_and_the_worst_first) {
  const auto body = strained(warped(sheet(SheetPattern::Quads, 5, 5), 0.2, 8), 5, all_springs());
  LawSettings settings = body->tear_laws[0].settings();
  settings.max_per_step = 3;
  TearLaw law(body->request_for(settings), settings);
  const ForceView view = body->view();
  const std::vector<Candidate> found = law.find(view);
  ASSERT_GT(found.size(), 3u);
  std::vector<TearEvent> events;
  EXPECT_EQ(law.apply(*body->map, view, events), 3);
  ASSERT_EQ(events.size(), 3u);
  for (std::size_t n = 0; n < 3; ++n) {
    EXPECT_EQ(events[n].dart, found[n].dart);
    EXPECT_EQ(events[n].value, found[n].value);
    EXPECT_TRUE(body->map->map().is_free(2, found[n].dart));
    const Vec3 a = body->map->position_of(found[n].dart);
    const Vec3 b = body->map->position_of(body->map->map().alpha(0, found[n].dart));
    EXPECT_EQ(events[n].place, Vec3(0.5 * (a + b)));
  }
  EXPECT_FALSE(body->map->map().is_free(2, found[3].dart));
}

TEST(Separate, opens_an_edge_once) {
  const auto body = strained(sheet(SheetPattern::Quads, 2, 1), 1e-9, all_springs());
  const ForceView view = body->view();
  Dart inner;
  body->map->map().for_each_dart([&](Dart d) {
    if (!body->map->map().is_free(2, d)) inner = d;
  });
  body->map->edit([&](Edit& edit) {
    EXPECT_TRUE(all_changes().front().apply(edit, view, Vec3(Vec3::Zero()), {&inner, 1}));
    EXPECT_FALSE(all_changes().front().apply(edit, view, Vec3(Vec3::Zero()), {&inner, 1}));
  });
  EXPECT_EQ(body->map->cells(Vertex).count(), 8u);
}

} // namespace
} // namespace rend::criterion_test
