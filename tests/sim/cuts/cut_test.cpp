// Cuts in sheets of triangles: where they run, what they keep, and that rows and surface, brought up to date
// after them, are those that are built from scratch.
#include "render/picture/scene_preset.h"
#include "sim/boundary/face_sense.h"
#include "sim/build/build_scene.h"
#include "sim/cuts/cuts.h"
#include "sim/cuts/start_element.h"
#include "sim/fracture/torn_checks.h"
#include "sim/presets.h"
#include "sim/scene/scene.h"
#include "sim/shipped_presets.h"

#include <gtest/gtest.h>

#include <set>

namespace rend::cut_test {
namespace {

using namespace cuts;
using namespace torn;

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

// With springs, where no vertex moves, or without.
std::unique_ptr<Body> sheet_of_triangles(unsigned seed) {
  auto map = sheet_from(meshes::warped(meshes::sheet(SheetPattern::Triangles, 4, 4), 0.15, seed));
  map->let_grow();
  map->add(FaceSense{});
  add_start_elements(*map);
  return torn::body(std::move(map), {}, "symplectic", true, seed % 2 == 0);
}

Vec3 in_plane(Noise& noise) {
  return Vec3(noise(), noise(), 0.2 * noise()).normalized();
}

std::unique_ptr<Body> flat_sheet_of_triangles(unsigned seed) {
  PolygonMesh mesh = meshes::warped(meshes::sheet(SheetPattern::Triangles, 6, 6), 0.15, seed);
  for (Vec3& x : mesh.points) x.z() = 0;
  auto map = sheet_from(mesh);
  map->let_grow();
  map->add(FaceSense{});
  add_start_elements(*map);
  return torn::body(std::move(map), {}, "symplectic", true, false);
}

TEST(Cut, opens_the_plane_across_the_tension_and_keeps_area_elastic_energy_mass_and_momentum) {
  Noise noise(7);
  int cuts = 0, divisions = 0, moves = 0, on_plane = 0, beside = 0;
  for (unsigned n = 0; n < 200; ++n) {
    const auto body = flat_sheet_of_triangles(n);
    const auto change = cuts_of(*body);
    const std::size_t slots = body->vertices();
    Dart d{noise.below(body->map->map().capacity())};
    const Vec3 normal = Vec3(noise(), noise(), 0).normalized(), other = Vec3(noise(), noise(), 0).normalized();
    stretch(*body, normal);
    const Vec3 here = body->map->position_of(d);
    const double before_area = area(*body), before_energy = energy(*body);
    const Snapshot before(*body);
    if (!cut_at(*body, *change, d, other)) continue;
    ++cuts;
    ASSERT_EQ(validate(*body->map), std::nullopt);
    EXPECT_NEAR(area(*body), before_area, 1e-12 * before_area);
    EXPECT_NEAR(energy(*body), before_energy, 1e-11 * before_energy);
    const Snapshot now(*body);
    expect_sums_kept(now, before, *body);
    divisions += body->vertices() > slots;
    body->map->map().for_each_dart([&](Dart e) {
      const bool moved = e.value < before.rest.size() && !same_bits(now.rest[e.value], before.rest[e.value]);
      moves += moved;
      if (!moved && (e.value < before.position.size() || body->map->vertex(e) < slots)) return;
      const double off = std::abs((body->map->position_of(e) - here).dot(normal));
      ++(off < 1e-12 ? on_plane : beside); // beside: where a part would be too thin
      EXPECT_LT(off, 0.25);                // a quarter of an edge
    });
    EXPECT_TRUE(same_bits(body->map->rest_of(Dart{0u}), before.rest[0])) << "it is fixed";
  }
  EXPECT_GT(cuts, 150);
  EXPECT_GT(divisions, 50);
  EXPECT_GT(moves, 100);
  EXPECT_LT(beside, on_plane / 20);
}

// The field at the tip of a straight crack along the negative x axis, in plane stress: displacements over
// √(1/2π) / 2G (Williams 1957), of a sheet of rings of triangles around the tip.
struct Tip {
  double one = 1, two = 0; // K_I, K_II
  Vec3 displacement(double r, double angle) const {
    const double kappa = (3 - poisson) / (1 + poisson), c = std::cos(angle / 2), s = std::sin(angle / 2);
    return std::sqrt(r) * Vec3(one * c * (kappa - 1 + 2 * s * s) + two * s * (kappa + 1 + 2 * c * c),
                               one * s * (kappa + 1 - 2 * c * c) - two * c * (kappa - 1 - 2 * s * s), 0);
  }
  static constexpr double poisson = 0.3;
  // To which the largest hoop stress turns the crack (Erdogan & Sih 1963) [degrees].
  double hoop_angle() const {
    if (two == 0) return 0;
    const double ratio = one / std::abs(two);
    return std::copysign(2 * std::atan((ratio - std::sqrt(ratio * ratio + 8)) / 4) * 180 / M_PI, -two);
  }
};

std::unique_ptr<Body> sheet_with_slit(int sectors, double turned) {
  PolygonMesh mesh;
  mesh.first = {0};
  mesh.points = {Vec3::Zero()};
  const int rings = 3, around = sectors + 1; // the two sides of the slit are apart
  for (int ring = 1; ring <= rings; ++ring)
    for (int n = 0; n < around; ++n) {
      const double inner = n == 0 || n == sectors ? 0 : turned;
      const double angle = -M_PI + 2 * M_PI * (n + inner) / sectors;
      mesh.points.push_back(ring * Vec3(std::cos(angle), std::sin(angle), 0));
    }
  const auto at = [&](int ring, int n) { return static_cast<std::uint32_t>(1 + (ring - 1) * around + n); };
  for (int n = 0; n < sectors; ++n) {
    mesh.add({0, at(1, n), at(1, n + 1)});
    for (int ring = 1; ring < rings; ++ring) {
      mesh.add({at(ring, n), at(ring + 1, n), at(ring + 1, n + 1)});
      mesh.add({at(ring, n), at(ring + 1, n + 1), at(ring, n + 1)});
    }
  }
  auto map = sheet_from(mesh);
  map->let_grow();
  map->add(FaceSense{});
  add_start_elements(*map);
  return torn::body(std::move(map), {}, "symplectic", true, false);
}

// The direction at rest of the edge that a cut at the tip opens [degrees], where what is at (r, angle) at rest
// is at place_of(r, angle).
template <class PlaceOf> double turn_at(Body& body, const PlaceOf& place_of) {
  const GMap& g = body.map->map();
  Dart at_tip{0u};
  for (Slot v = 0; v < body.vertices(); ++v) {
    const Vec3 rest = body.map->rest()[v];
    double angle = std::atan2(rest.y(), rest.x());
    const Dart d = body.map->cells(Vertex).first_dart(v);
    if (rest.norm() < 1e-9) at_tip = d;
    if (std::abs(angle) > M_PI - 1e-9) // on the side of the slit on which its element lies
      angle = std::copysign(M_PI, body.map->rest_of(g.alpha(0, g.alpha(1, g.alpha(0, d)))).y() +
                                      body.map->rest_of(g.alpha(0, g.alpha(1, d))).y());
    body.map->position().values()[v] = Record(Vec3(place_of(rest.norm(), angle)));
  }
  body.evaluate();
  std::set<std::pair<double, double>> open;
  const auto border = [&](std::set<std::pair<double, double>>& ends) {
    for (Dart d : darts_of(g, Component, at_tip))
      if (g.is_free(2, d) && body.map->rest_of(d).norm() < 1e-9) {
        const Vec3 end = body.map->rest_of(g.alpha(0, d));
        ends.insert({end.x(), end.y()});
      }
  };
  border(open);
  EXPECT_TRUE(cut_at(body, *cuts_of(body), at_tip, Vec3(0, 1, 0)));
  std::set<std::pair<double, double>> ends;
  border(ends);
  for (const auto& [x, y] : ends)
    if (!open.contains({x, y})) return std::atan2(y, x) * 180 / M_PI;
  ADD_FAILURE() << "nothing has opened";
  return 0;
}

TEST(Cut, at_the_tip_of_a_crack_turns_as_the_largest_hoop_stress_asks) {
  for (const Tip tip : {Tip{1, 0}, Tip{1, 0.2}, Tip{1, 0.5}, Tip{1, 1}, Tip{1, -1}, Tip{1, 2}, Tip{0, 1}})
    for (const int sectors : {8, 11, 16})
      for (const double turned : {0.0, 0.15, 0.3}) {
        const auto body = sheet_with_slit(sectors, turned);
        const auto place_of = [&](double r, double angle) {
          return Vec3(r * Vec3(std::cos(angle), std::sin(angle), 0) + 1e-4 * tip.displacement(r, angle));
        };
        EXPECT_NEAR(turn_at(*body, place_of), tip.hoop_angle(), 4)
            << tip.one << " " << tip.two << ", " << sectors << " sectors, turned by " << turned;
      }
}

// The flanks are folded up and down by that angle, and pulled: tension runs along them. Ahead of the tip the
// sheet is tilted.
TEST(Cut, at_the_tip_of_a_crack_goes_on_between_flanks_that_are_pulled_up_and_down) {
  for (const double folded : {60.0, 75.0, 90.0})
    for (const int sectors : {8, 11, 16})
      for (const double turned : {0.0, 0.15, 0.3}) {
        const auto body = sheet_with_slit(sectors, turned);
        const double up = std::sin(folded * M_PI / 180), along = std::cos(folded * M_PI / 180);
        const auto place_of = [&](double r, double angle) {
          const double x = r * std::cos(angle), y = r * std::sin(angle), leg = std::max(-1.05 * x, 0.0);
          return Vec3(std::max(x, 0.0) - along * leg, y, 0.1 * y + std::copysign(up * leg, angle));
        };
        EXPECT_NEAR(turn_at(*body, place_of), 0, 15)
            << "folded by " << folded << ", " << sectors << " sectors, turned by " << turned;
      }
}

// A dart of each vertex at that distance from the tip, without the slit.
std::vector<Dart> at_distance(const Body& body, double distance) {
  std::vector<Dart> darts;
  for (Slot v = 0; v < body.vertices(); ++v)
    if (const Vec3 rest = body.map->rest()[v];
        std::abs(rest.norm() - distance) < 1e-9 && (distance == 0 || std::abs(rest.y()) > 1e-9))
      darts.push_back(body.map->cells(Vertex).first_dart(v));
  return darts;
}

TEST(Cut, goes_on_from_the_tip_of_a_crack_and_not_from_vertices_beside_it) {
  const auto body = sheet_with_slit(11, 0.1);
  const auto change = cuts_of(*body);
  std::size_t refused = 0;
  for (const double distance : {1, 2}) // as many edges
    for (Dart d : at_distance(*body, distance)) {
      EXPECT_FALSE(cut_at(*body, *change, d, Vec3(0.6, 0.8, 0)));
      ++refused;
    }
  ASSERT_GT(refused, 0u);
  EXPECT_EQ(change->memory->refusals(),
            (Refusals{{"a crack ends beside the vertex, and goes on from there", refused}}));
  EXPECT_TRUE(std::ranges::any_of(at_distance(*body, 3),
                                  [&](Dart d) { return cut_at(*body, *change, d, Vec3(1, 0, 0)); }));
}

// Nor from those beside where it was, and where it has come to in the same step.
TEST(Cut, goes_on_from_the_tip_alone_within_a_step) {
  for (const double distance : {1, 2}) {
    const auto body = sheet_with_slit(11, 0.1);
    const auto change = cuts_of(*body);
    const Dart tip = at_distance(*body, 0).front();
    const std::vector<Dart> beside = at_distance(*body, distance);
    ASSERT_FALSE(beside.empty());
    const ForceView view = body->view();
    change->memory->begin(view);
    body->map->edit([&](Edit& edit) {
      const auto cut = [&](Dart d, const Vec3& normal) {
        return change->apply(edit, view, normal, darts_of(body->map->map(), Vertex, d));
      };
      EXPECT_TRUE(cut(tip, Vec3(0, 1, 0)));
      for (Dart d : beside) EXPECT_FALSE(cut(d, Vec3(0.6, 0.8, 0)));
    });
  }
}

TEST(Cut, leaves_what_is_built_from_scratch) {
  Noise noise(11);
  long cuts = 0;
  for (unsigned n = 0; n < 80; ++n) {
    const auto body = sheet_of_triangles(100 + n);
    const auto change = cuts_of(*body);
    Seen seen(*body);
    for (int k = 0; k < 200; ++k) {
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
  EXPECT_GT(cuts, 2000);
}

// Of all elements at rest, in increasing order [degrees].
std::vector<double> angles(const Body& body) {
  std::vector<double> all;
  const GMap& g = body.map->map();
  g.for_each_dart([&](Dart d) {
    if (g.alpha(1, d) < d) return;
    const Vec3 here = body.map->rest_of(d), u = body.map->rest_of(g.alpha(0, d)) - here,
               v = body.map->rest_of(g.alpha(0, g.alpha(1, d))) - here;
    all.push_back(std::atan2(u.cross(v).norm(), u.dot(v)) * 180 / M_PI);
  });
  std::ranges::sort(all);
  return all;
}

double least_sine(const Body& body) {
  const std::vector<double> all = angles(body);
  return std::min(std::sin(all.front() * M_PI / 180), std::sin(all.back() * M_PI / 180));
}

TEST(Cut, makes_no_part_below_its_share_and_no_more_than_four_times_the_elements) {
  for (const double share : {1.0 / 20, 0.15}) {
    Noise noise(13);
    const auto body = sheet_of_triangles(3);
    const auto change = cuts_of(*body, share);
    const std::size_t elements = count_cells(body->map->map()).faces;
    double smallest = area(*body), after = smallest;
    const double sine = least_sine(*body);
    for_each_face(*body->map, [&](Dart d) { smallest = std::min(smallest, area_of(*body, d)); });
    for (int k = 0; k < 1000; ++k)
      cut_at(*body, *change, Dart{noise.below(body->map->map().capacity())}, in_plane(noise));
    EXPECT_GT(count_cells(body->map->map()).faces, (share < 0.1 ? 2 : 1) * elements);
    EXPECT_LE(count_cells(body->map->map()).faces, 4 * elements);
    for_each_face(*body->map, [&](Dart d) { after = std::min(after, area_of(*body, d)); });
    EXPECT_GE(after, share * smallest * (1 - 1e-12));
    EXPECT_LT(after, 3 * share * smallest);
    EXPECT_GE(least_sine(*body), (share < 0.1 ? 0.25 : 0.6) * sine);
  }
}

TEST(Cut, leaves_no_slivers_after_500) {
  Noise noise(17);
  for (unsigned seed : {1u, 2u, 3u}) {
    PolygonMesh mesh = meshes::warped(meshes::sheet(SheetPattern::Triangles, 20, 20), 0.15, seed);
    for (Vec3& x : mesh.points) x.z() = 0;
    auto map = sheet_from(mesh);
    map->let_grow();
    map->add(FaceSense{});
    add_start_elements(*map);
    const auto body = torn::body(std::move(map), {}, "symplectic", true, false);
    const auto change = cuts_of(*body);
    const double least = angles(*body).front();
    for (int cuts = 0, tries = 0; cuts < 500 && tries < 5000; ++tries)
      cuts += cut_at(*body, *change, Dart{noise.below(body->map->map().capacity())}, in_plane(noise));
    const std::vector<double> after = angles(*body);
    EXPECT_GE(after.front(), least / 6);
    EXPECT_GE(after[after.size() / 100], least / 4);
  }
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
    change->memory->settle_candidate(true, "");
    EXPECT_FALSE(change->apply(edit, view, Vec3(0.3, 1, 0).normalized(), other));
    change->memory->settle_candidate(false, "");
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

// Kinetic and elastic [J], from the map alone.
double energy_of_matter(const Body& body) {
  return kinetic_energy(*body.map, *body.mass) + energy(body);
}

// What cuts do to the energy is booked, and nothing else.
TEST(Cut, accounts_for_what_it_changes) {
  const auto loaded = presets::load(strip(R"(<tear criterion="vertex-stress" threshold="1e4" change="cut"/>)"));
  Body& body = *loaded->bodies()[0];
  double before = 0, sum = 0, size = 0;
  body.change_observer = [&](WitnessAt at) {
    const double now = energy_of_matter(body);
    if (at == WitnessAt::BeforeChanges) before = now;
    if (at != WitnessAt::AfterChanges) return;
    sum += now - before;
    size += std::abs(now - before);
  };
  for (int n = 0; n < 1000 && loaded->fragments() < 2; ++n) loaded->step();
  EXPECT_GE(loaded->fragments(), 2u);
  EXPECT_GT(size, 0);
  EXPECT_NEAR(body.work_meter->work().remesh, sum, 1e-9 * before);
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
  EXPECT_LT(cut.furthest, 0.0075); // a quarter of an edge of the far side
  EXPECT_LT(cut.length, 1.03 * 0.36);
  EXPECT_LT(cut.furthest, split.furthest / 2);
  EXPECT_LT(cut.length, split.length);
}

} // namespace
} // namespace rend::cut_test
