// Edges that are divided at a share of their length: what is made, and from whom the new vertex inherits.
#include "sim/house_rules/house_rules.h"
#include "sim/mechanics/mass.h"
#include "sim/mesh/bar.h"
#include "sim/mesh/cells.h"
#include "sim/random_meshes.h"
#include "tests/sim/assets.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace rend::divide_edge_test {
namespace {

using meshes::Noise;

// The area [m²] or volume [m³] at rest, summed element by element.
double size_at_rest(const EmbeddedMap& body) {
  const bool solid = body.map().dimension() == 3;
  const Orbit element = solid ? Volume : Face;
  double sum = 0;
  body.map().for_each_dart([&](Dart d) {
    if (smallest_dart(body.map(), element, d) != d) return;
    std::map<Slot, Vec3> corners;
    for (Dart e : darts_of(body.map(), element, d)) corners[body.vertex(e)] = body.rest_of(e);
    std::vector<Vec3> x;
    for (const auto& [slot, at] : corners) x.push_back(at - corners.begin()->second);
    ASSERT_EQ(x.size(), solid ? 4u : 3u);
    sum += solid ? std::abs(x[1].cross(x[2]).dot(x[3])) / 6 : x[1].cross(x[2]).norm() / 2;
  });
  return sum;
}

std::size_t elements_around(const EmbeddedMap& body, Dart d) {
  const Orbit element = body.map().dimension() == 3 ? Volume : Face;
  std::set<Dart> around;
  for (Dart e : darts_of(body.map(), Edge, d)) around.insert(smallest_dart(body.map(), element, e));
  return around.size();
}

// Sixty edges at random, borders among them, each named from either of its ends.
void divide_at_random(EmbeddedMap& body, const char* name) {
  Noise noise(3);
  const double whole = size_at_rest(body);
  const int euler = static_cast<int>(count_cells(body.map()).euler);
  for (int n = 0; n < 60; ++n) {
    const std::vector<Dart> darts = assets::all_darts(body.map());
    const Dart d = darts[noise.below(darts.size())];
    const double share = 0.5 + 0.4 * noise();
    const Vec3 at = (1 - share) * body.rest_of(d) + share * body.rest_of(body.map().alpha(0, d));
    const std::size_t around = elements_around(body, d);
    const CellCounts before = count_cells(body.map());
    const Applied done = apply(rule(name), body, d, {{"share", scalar_value(share)}});
    ASSERT_TRUE(done.ok) << done.reason;
    const auto fault = validate(body);
    ASSERT_FALSE(fault) << fault.value_or("");
    const CellCounts now = count_cells(body.map());
    const bool solid = body.map().dimension() == 3;
    EXPECT_EQ(solid ? now.volumes : now.faces, (solid ? before.volumes : before.faces) + around);
    EXPECT_EQ(now.vertices, before.vertices + 1);
    EXPECT_EQ(now.euler, euler);
    EXPECT_LT((body.rest_of(done.dart("g")) - at).norm(), 1e-14);
  }
  EXPECT_NEAR(size_at_rest(body), whole, 1e-12 * whole);
}

TEST(DivideEdge, of_triangles_keeps_area_and_adds_one_triangle_a_side) {
  const auto body = assets::triangulated_grid(3, 2);
  divide_at_random(*body, "divide-edge-of-triangles");
}

TEST(DivideEdge, of_tetrahedra_keeps_volume_and_adds_one_for_each_around) {
  const auto body = solid_from(bar_cells({BarPattern::Tetrahedra, 2, 1, 1, Vec3(2, 1, 1)}));
  divide_at_random(*body, "divide-edge-of-tetrahedra");
}

TEST(DivideEdge, refuses_a_share_that_is_not_inside_the_edge) {
  const auto body = assets::triangulated_grid(1, 1);
  for (double share : {-0.5, 0.0, 1.0, 2.0})
    EXPECT_EQ(apply(rule("divide-edge-of-triangles"), *body, Dart{0u}, {{"share", scalar_value(share)}}).reason,
              "\"divide-edge-of-triangles\" does not apply: the share is not between 0 and 1");
  EXPECT_FALSE(apply(rule("divide-edge-of-triangles"), *assets::single_quad(), Dart{0u}).ok);
}

// How much a, A and other vertices count as parents of a vertex whose place is given by an expression.
std::vector<double> weights(const std::string& place, RuleSettings settings = divide_edge_of_triangles()) {
  settings.sets[0].position = place;
  const Rule rule(settings);
  const auto body = assets::triangulated_grid(2, 2);
  body->add(CornerMass{.density = 1}.on(*body));
  const Dart a{0u}, A = body->map().alpha(0, a);
  std::vector<double> found(3);
  body->edit([&](Edit& edit) {
    const Applied done = apply(rule, edit, a, {{"share", scalar_value(0.3)}});
    ASSERT_TRUE(done.ok) << done.reason;
    for (const Parent& parent : edit.parents(done.dart("g"), Vertex)) {
      const Slot v = body->vertex(parent.dart);
      found[v == body->vertex(a) ? 0 : v == body->vertex(A) ? 1 : 2] += parent.weight;
    }
  });
  return found;
}

void expect_weights(const std::string& place, std::vector<double> expected, std::vector<double> found) {
  for (std::size_t n = 0; n < 3; ++n) EXPECT_NEAR(found[n], expected[n], 1e-14) << place << " " << n;
}

TEST(DivideEdge, weights_are_those_of_the_expression) {
  const auto expect = [](const std::string& place, std::vector<double> expected) {
    expect_weights(place, std::move(expected), weights(place));
  };
  expect("lerp(a, A, share)", {0.7, 0.3, 0});
  expect("a + share*(A - a)", {0.7, 0.3, 0});
  expect("0.7*a + 0.3*A", {0.7, 0.3, 0});
  expect("lerp(a, A, share) + 0*c", {0.7, 0.3, 0});
  expect("lerp(a, mean(a, edge), 0.5) + 0*A", {0.75, 0.25, 0});
  expect("lerp(a, A, dot(point(0.5, 0, 0) - a, point(1, 0.3, 0)) / dot(A - a, point(1, 0.3, 0)))",
         {0.5, 0.5, 0}); // where a plane crosses the edge
  expect("lerp(a, A, 0.4) + 0.001*normal(a, vertex)", {0.6, 0.4, 0});
  expect("a + norm(A - a)*0.3*(A - a)",
         {0.6, 0.4, 0}); // weights that move with the points: by how often each is named
  expect("a + 0.5*(A - a)*if(norm(A - a) > 0, 1, 0)", {0.5, 0.5, 0});
}

TEST(DivideEdge, weights_go_through_a_let) {
  RuleSettings settings = divide_edge_of_triangles();
  settings.lets = {{.name = "middle", .value = "lerp(a, A, share)"}};
  expect_weights("middle", {0.7, 0.3, 0}, weights("middle", settings));
  expect_weights("lerp(a, middle, 0.5)", {0.85, 0.15, 0}, weights("lerp(a, middle, 0.5)", settings));
}

} // namespace
} // namespace rend::divide_edge_test
