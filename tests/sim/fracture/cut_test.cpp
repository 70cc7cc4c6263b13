// Cuts in sheets of triangles: where they run, what they keep, and that rows and surface, brought up to date
// after them, are those that are built from scratch.
#include "render/picture/scene_preset.h"
#include "sim/boundary/face_sense.h"
#include "sim/build/build_scene.h"
#include "sim/fracture/change.h"
#include "sim/fracture/torn_bodies.h"
#include "sim/fracture/torn_checks.h"
#include "sim/presets.h"
#include "sim/rows/continuum.h"
#include "sim/scene/scene.h"
#include "sim/shipped_presets.h"

#include <gtest/gtest.h>

namespace rend::cut_test {
namespace {

using namespace torn;

// Cuts at one vertex, by the plane with that normal.
bool cut_at(Body& body, const ChangeType& change, Dart d, const Vec3& normal) {
  bool made = false;
  const ForceView view = body.view();
  change.memory->begin(view);
  body.map->edit([&](Edit& edit) {
    made = change.apply(edit, view, normal, darts_of(body.map->map(), Vertex, d));
    change.memory->settle_candidate(made);
  });
  body.rebind();
  body.evaluate();
  return made;
}

// Of the triangle of d, at rest [m²].
double area_of(const Body& body, Dart d) {
  const GMap& g = body.map->map();
  const Vec3 a = body.map->rest_of(d), b = body.map->rest_of(g.alpha(0, d)),
             c = body.map->rest_of(g.alpha(0, g.alpha(1, d)));
  return (b - a).cross(c - a).norm() / 2;
}

double area(const Body& body) {
  double sum = 0;
  for_each_face(*body.map, [&](Dart d) { sum += area_of(body, d); });
  return sum;
}

// Of elasticity, without the springs [J].
double energy(const Body& body) {
  double sum = 0;
  for_each_unit(*body.map, body.interactions, [&](const Interaction& interaction, Dart d, std::size_t unit) {
    const CurrentUnit now(*body.map, interaction, d, unit, meshes::positions(body), nullptr);
    if (now.acts() && interaction.name.starts_with("co-rotational"))
      sum += interaction.law->energy(now.values, now.state());
  });
  return sum;
}

std::unique_ptr<Body> sheet_of_triangles(unsigned seed) {
  auto map = sheet_from(meshes::warped(meshes::sheet(SheetPattern::Triangles, 4, 4), 0.15, seed));
  map->let_grow();
  map->add(FaceSense{});
  return torn::body(std::move(map), {}, "symplectic", true);
}

std::shared_ptr<const ChangeType> cuts_of(Body& body) {
  return find_change("cut")->of_law(
      body.request_for(LawSettings{.criterion = find_criterion("vertex-stress")}));
}

Vec3 in_plane(Noise& noise) {
  return Vec3(noise(), noise(), 0.2 * noise()).normalized();
}

TEST(Cut, opens_the_plane_and_keeps_area_elastic_energy_mass_and_momentum) {
  Noise noise(7);
  int cuts = 0, divisions = 0;
  for (unsigned n = 0; n < 60; ++n) {
    const auto body = sheet_of_triangles(n);
    const auto change = cuts_of(*body);
    const std::size_t slots = body->vertices();
    Dart d{noise.below(body->map->map().capacity())};
    const Vec3 normal = in_plane(noise), here = body->map->position_of(d);
    const double before_area = area(*body), before_energy = energy(*body);
    const Snapshot before(*body);
    if (!cut_at(*body, *change, d, normal)) continue;
    ++cuts;
    ASSERT_EQ(validate(*body->map), std::nullopt);
    EXPECT_NEAR(area(*body), before_area, 1e-12 * before_area);
    EXPECT_NEAR(energy(*body), before_energy, 1e-12 * before_energy);
    expect_sums_kept(Snapshot(*body), before, *body);
    divisions += body->vertices() > slots;
    body->map->map().for_each_dart([&](Dart e) {
      if (e.value >= before.position.size() && body->map->vertex(e) >= slots) {
        EXPECT_NEAR((body->map->position_of(e) - here).dot(normal), 0, 1e-13);
      }
    });
  }
  EXPECT_GT(cuts, 40);
  EXPECT_GT(divisions, 20);
}

TEST(Cut, leaves_what_is_built_from_scratch) {
  Noise noise(11);
  long cuts = 0;
  for (unsigned n = 0; n < 20; ++n) {
    const auto body = sheet_of_triangles(100 + n);
    const auto change = cuts_of(*body);
    Seen seen(*body);
    for (int k = 0; k < 100; ++k) {
      Dart d{noise.below(body->map->map().capacity())};
      cuts += cut_at(*body, *change, d, in_plane(noise));
      ASSERT_EQ(validate(*body->map), std::nullopt);
      for_each_face(*body->map, [&](Dart face) { ASSERT_EQ(sides_of_face(body->map->map(), face), 3); });
      if (k % 10 > 0) continue;
      seen.update();
      expect_as_built_anew(*body, seen);
      if (HasFailure()) FAIL() << "after cut " << cuts << " of body " << n;
    }
  }
  EXPECT_GT(cuts, 700);
}

TEST(Cut, makes_no_part_below_a_twentieth_and_no_more_than_four_times_the_elements) {
  Noise noise(13);
  const auto body = sheet_of_triangles(3);
  const auto change = cuts_of(*body);
  const std::size_t elements = count_cells(body->map->map()).faces;
  double smallest = area(*body);
  for_each_face(*body->map, [&](Dart d) { smallest = std::min(smallest, area_of(*body, d)); });
  for (int k = 0; k < 1000; ++k)
    cut_at(*body, *change, Dart{noise.below(body->map->map().capacity())}, in_plane(noise));
  EXPECT_GT(count_cells(body->map->map()).faces, 2 * elements);
  EXPECT_LE(count_cells(body->map->map()).faces, 4 * elements);
  for_each_face(*body->map, [&](Dart d) { EXPECT_GE(area_of(*body, d), smallest / 20 * (1 - 1e-12)); });
}

// Of the vertices of one element, cut in one edit, the second waits: its plane is of elements that are gone.
TEST(Cut, of_a_neighbour_waits_for_the_next_step) {
  const auto body = sheet_of_triangles(1);
  const auto change = cuts_of(*body);
  const ForceView view = body->view();
  const GMap& map = body->map->map();
  Dart d{0u};
  const auto inside = [&](Dart v) {
    return std::ranges::none_of(darts_of(map, Vertex, v), [&](Dart e) { return map.is_free(2, e); });
  };
  while (!inside(d) || !inside(map.alpha(0, d))) d = Dart{d.value + 1};
  const std::vector<Dart> one = darts_of(map, Vertex, d), other = darts_of(map, Vertex, map.alpha(0, d));
  change->memory->begin(view);
  body->map->edit([&](Edit& edit) {
    EXPECT_TRUE(change->apply(edit, view, Vec3(0.3, 1, 0).normalized(), one));
    change->memory->settle_candidate(true);
    EXPECT_FALSE(change->apply(edit, view, Vec3(0.3, 1, 0).normalized(), other));
    change->memory->settle_candidate(false);
  });
  EXPECT_EQ(change->memory->refusals(),
            (Refusals{{"another cut of the same step has changed an element at the vertex", 1}}));
  EXPECT_EQ(validate(*body->map), std::nullopt);
}

std::string strip(const std::string& law) {
  return R"(<scene><body><sheet pattern="triangles" cells="20 10" size="2 1"/>
    <mass density="1000" thickness="1e-3"/>
    <elasticity model="corotational" young="2e5" thickness="1e-3" damping-mass="100"/>
    <drive side="-x" velocity="-0.1 0 0"/><drive side="+x" velocity="0.1 0 0"/>)" +
         law + R"(</body><world gravity="0 0 0"/><time step="auto" duration="1"/></scene>)";
}

// Sides that a cut makes were inside an element: they are torn, as the others are.
TEST(Cut, sides_count_as_torn) {
  const auto loaded = presets::load(
      strip(R"(<tear criterion="vertex-stress" threshold="1e4" change="cut" max-per-step="1"/>)"));
  for (int n = 0; n < 400 && loaded->tears() < 6; ++n) loaded->step();
  ASSERT_GE(loaded->tears(), 6u);
  const Body& body = loaded.body();
  std::size_t open = 0, torn_sides = 0;
  body.map->map().for_each_dart([&](Dart d) {
    if (!body.map->map().is_free(2, d)) return;
    ++open;
    torn_sides += (*body.border)[body.map->slot(EdgeOfFace, d)] == 0;
  });
  EXPECT_EQ(open / 2 - torn_sides / 2, 60u); // the border at the start
  EXPECT_GT(torn_sides, 0u);
}

struct Crack {
  double length = 0, furthest = 0; // at rest [m]; from the line x = 0
};

Crack crack_through(const std::string& name) {
  const auto preset = load_scene(shipped::path_of(name));
  Scene scene(read_scene(*preset), {});
  while (scene.fragments() < 2 && scene.time() < 1.2)
    for (int n = 0; n < 50; ++n) scene.step();
  EXPECT_GE(scene.fragments(), 2u);
  const Body& body = *scene.bodies()[0];
  Crack crack;
  body.map->map().for_each_dart([&](Dart d) {
    const Dart e = body.map->map().alpha(0, d);
    if (!body.map->map().is_free(2, d) || e < d || (*body.border)[body.map->slot(EdgeOfFace, d)] != 0) return;
    crack.length += (body.map->rest_of(d) - body.map->rest_of(e)).norm() / 2; // it has two sides
    for (Dart end : {d, e}) crack.furthest = std::max(crack.furthest, std::abs(body.map->rest_of(end).x()));
  });
  return crack;
}

// A strip of 0.4 m with a round notch of 0.04 m, pulled across, in triangles of 5 mm at the notch and 30 mm at
// the far side: the shortest crack has 0.36 m.
TEST(Cut, runs_straighter_than_along_the_edges_of_the_mesh) {
  const Crack cut = crack_through("tear/notched-strip-cut"), split = crack_through("tear/notched-strip");
  EXPECT_LT(cut.furthest, 0.015); // half an edge of the far side
  EXPECT_LT(cut.length, 1.15 * 0.36);
  EXPECT_LT(cut.furthest, split.furthest / 2);
  EXPECT_LT(cut.length, split.length);
}

} // namespace
} // namespace rend::cut_test
