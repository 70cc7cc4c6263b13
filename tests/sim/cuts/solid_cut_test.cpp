// Cuts in solids of tetrahedra: what they keep, what they leave, and that a bar parts in a smooth section.
#include "sim/build/build_scene.h"
#include "sim/cuts/crack_front.h"
#include "sim/cuts/cuts.h"
#include "sim/cuts/start_element.h"
#include "sim/fracture/change.h"
#include "sim/fracture/torn_checks.h"
#include "sim/presets.h"
#include "sim/scene/scene.h"
#include "sim/shipped_presets.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace rend::solid_cut_test {
namespace {

using namespace cuts;
using namespace torn;

// Six times the volume of the tetrahedron of d, at rest [m³].
double six_volumes(const Body& body, Dart d) {
  const GMap& g = body.map->map();
  const Vec3 a = body.map->rest_of(d), b = body.map->rest_of(g.alpha(0, d)) - a,
             c = body.map->rest_of(g.alpha(0, g.alpha(1, d))) - a,
             e = body.map->rest_of(g.alpha(0, g.alpha(1, g.alpha(2, d)))) - a;
  return std::abs(b.cross(c).dot(e));
}

// The smallest dart of each tetrahedron.
std::vector<Dart> tetrahedra(const Body& body) {
  std::vector<Dart> all;
  body.map->map().for_each_dart([&](Dart d) {
    if (smallest_dart(body.map->map(), Volume, d) == d) all.push_back(d);
  });
  return all;
}

std::vector<double> sizes(const Body& body) {
  std::vector<double> all;
  for (Dart d : tetrahedra(body)) all.push_back(six_volumes(body, d));
  return all;
}

double volume(const Body& body) {
  double sum = 0;
  for (double size : sizes(body)) sum += size / 6;
  return sum;
}

std::unique_ptr<Body> bar_of_tetrahedra(unsigned seed, bool springs, const elements::Elastic& elastic = {},
                                        double warp = 0.1) {
  auto map = solid_from(elements::warped_bar(BarPattern::Tetrahedra, 3, 3, 3, warp, seed));
  map->let_grow();
  add_start_elements(*map);
  return torn::body(std::move(map), {}, "symplectic", true, springs, elastic);
}

Vec3 direction(Noise& noise) {
  return noise.vector().normalized();
}

Dart some_dart(const Body& body, Noise& noise) {
  return Dart{noise.below(body.map->map().capacity())};
}

// With flat sides, on which vertices move, and with warped ones.
TEST(SolidCut, keeps_volume_elastic_energy_mass_and_momentum) {
  Noise noise(7);
  for (const auto& [model, warp] :
       {std::pair{"corotational", 0.0}, {"corotational", 0.1}, {"linear", 0.0}, {"linear", 0.1}}) {
    int cuts = 0, divisions = 0, moves = 0;
    for (unsigned n = 0; n < 40; ++n) {
      const auto body = bar_of_tetrahedra(n, false, {.model = model}, warp);
      const auto change = cuts_of(*body);
      const Vec3 normal = direction(noise), other = direction(noise);
      stretch(*body, normal);
      for (int k = 0; k < 12; ++k) {
        const std::size_t slots = body->vertices();
        const double before_volume = volume(*body), before_energy = energy(*body);
        const Snapshot before(*body);
        if (!cut_at(*body, *change, some_dart(*body, noise), other)) continue;
        ++cuts;
        ASSERT_EQ(validate(*body->map), std::nullopt);
        EXPECT_NEAR(volume(*body), before_volume, 1e-11 * before_volume);
        EXPECT_NEAR(energy(*body), before_energy, 1e-11 * before_energy);
        const Snapshot now(*body);
        expect_sums_kept(now, before, *body);
        divisions += body->vertices() > slots + 1;
        body->map->map().for_each_dart([&](Dart e) {
          moves += e.value < before.rest.size() && !same_bits(now.rest[e.value], before.rest[e.value]);
        });
        EXPECT_TRUE(same_bits(body->map->rest_of(Dart{0u}), before.rest[0])) << "it is fixed";
      }
    }
    EXPECT_GT(cuts, 100);
    EXPECT_GT(divisions, 50);
    EXPECT_GT(moves, 100);
  }
}

TEST(SolidCut, leaves_what_is_built_from_scratch) {
  Noise noise(11);
  long cuts = 0;
  for (unsigned n = 0; n < 10; ++n) {
    const auto body = bar_of_tetrahedra(100 + n, n % 2 == 0);
    const auto change = cuts_of(*body);
    Seen seen(*body);
    for (int k = 0; k < 100; ++k) {
      cuts += cut_at(*body, *change, some_dart(*body, noise), direction(noise));
      ASSERT_EQ(validate(*body->map), std::nullopt);
      if (k % 10 > 0) continue;
      seen.update();
      expect_as_built_anew(*body, seen);
      if (HasFailure()) FAIL() << "after cut " << cuts << " of body " << n;
    }
    for (Dart d : tetrahedra(*body)) ASSERT_EQ(darts_of(body->map->map(), Volume, d).size(), 24u);
  }
  EXPECT_GT(cuts, 250);
}

TEST(SolidCut, makes_no_part_below_its_share_and_no_more_than_four_times_the_elements) {
  for (const double share : {1.0 / 20, 0.15}) {
    Noise noise(13);
    const auto body = bar_of_tetrahedra(3, false);
    const auto change = cuts_of(*body, share);
    const std::vector<double> start = sizes(*body);
    const double smallest = std::ranges::min(start);
    for (int k = 0; k < 1000; ++k) cut_at(*body, *change, some_dart(*body, noise), direction(noise));
    const std::vector<double> now = sizes(*body);
    EXPECT_GT(now.size(), (share < 0.1 ? 3 : 2) * start.size() / 2);
    EXPECT_LE(now.size(), 4 * start.size());
    EXPECT_GE(std::ranges::min(now), share * smallest * (1 - 1e-12));
    EXPECT_LT(std::ranges::min(now), 3 * share * smallest);
  }
}

struct Section {
  double area = 0, furthest = 0; // at rest [m²]; from the plane [m]
};

// Of what has torn, beside a plane.
Section torn_section(const Body& body, const Vec3& normal, const Vec3& on_plane) {
  const GMap& g = body.map->map();
  Section section;
  g.for_each_dart([&](Dart d) {
    if (!g.is_free(3, d) || (*body.border)[body.map->slot(body.border->orbit(), d)] != 0) return;
    const Vec3 a = body.map->rest_of(d), b = body.map->rest_of(g.alpha(0, d)) - a,
               c = body.map->rest_of(g.alpha(0, g.alpha(1, d))) - a;
    section.area += b.cross(c).norm() / 2 / 6 / 2; // six darts of each face, on two sides
    section.furthest = std::max(section.furthest, std::abs((a - on_plane).dot(normal)));
  });
  return section;
}

std::string words(const Vec3& x) {
  return fmt::format("{} {} {}", x.x(), x.y(), x.z());
}

struct Parted {
  Section section;
  std::size_t fragments;
};

// The bar of the preset, turned about its length: its ends turn about a line below it until it parts.
Parted parted_bar(double turned) {
  const Eigen::Matrix3d R = Eigen::AngleAxisd(turned * M_PI / 180, Vec3::UnitX()).toRotationMatrix();
  const std::string mesh = (shipped::folder() / "fracture/meshes/notched-bar.msh").string();
  const auto end = [&](const std::string& side, double rate) {
    return fmt::format(R"(<drive side="{}" rotate="{} {}" centre="{}"/>)", side, words(R * Vec3::UnitY()), rate,
                       words(R * Vec3(0, 0, -0.25)));
  };
  const presets::Loaded scene = presets::load(fmt::format(
      R"(<scene><body><mesh file="{}"/><place rotate="{} 0 0"/><mass density="1000"/>
    <elasticity young="5e5" damping-mass="50" damping-stiffness="2e-5"/>{}{}
    <tear criterion="vertex-stress" threshold="8e4" change="cut"/></body><world gravity="0 0 0"/>
    <time step="auto" duration="2"/></scene>)",
      mesh, turned, end("-x", -3), end("+x", 3)));
  while (scene->fragments() < 2 && scene->time() < 1.5) scene->step();
  EXPECT_EQ(validate(*scene.body().map), std::nullopt);
  return {torn_section(scene.body(), Vec3::UnitX(), Vec3::Zero()), scene->fragments()};
}

// All vertices on fronts, one dart of each.
std::vector<Dart> front_vertices(const Body& body) {
  std::vector<Dart> all;
  for (Slot v = 0; v < body.vertices(); ++v) {
    if (!body.map->cells(Vertex).alive(v)) continue;
    const Dart d = body.map->cells(Vertex).first_dart(v);
    if (CrackFront(*body.map, darts_of(body.map->map(), Vertex, d)).passes()) all.push_back(d);
  }
  return all;
}

// Under uniform tension along x, from one cut in the middle on, wherever the front may go on.
TEST(SolidCut, at_the_front_goes_on_without_bridges_until_a_body_is_in_two) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const auto body = torn::body(solid_from(elements::warped_bar(BarPattern::Tetrahedra, 5, 5, 5, 0.1, seed)),
                                 {}, "symplectic", false, false);
    body->map->let_grow(); // after its initial border is known
    add_start_elements(*body->map);
    stretch(*body, Vec3::UnitX());
    const auto change = cuts_of(*body);
    const Dart middle = cell_at(*body, Cell::Vertices, {2.5, 2.5, 2.5});
    const Vec3 here = body->map->rest_of(middle);
    ASSERT_TRUE(cut_at(*body, *change, middle, Vec3::UnitX()));
    EXPECT_FALSE(front_vertices(*body).empty());
    for (bool any = true; any;) {
      any = false;
      for (Dart d : front_vertices(*body)) any = cut_at(*body, *change, d, Vec3::UnitX()) || any;
    }
    const Section section = torn_section(*body, Vec3::UnitX(), here);
    EXPECT_EQ(validate(*body->map), std::nullopt);
    EXPECT_EQ(count_cells(body->map->map()).fragments, 2u);
    EXPECT_TRUE(front_vertices(*body).empty());
    EXPECT_NEAR(section.area, 25, 0.025 * 25); // of a bar whose sides are warped
    EXPECT_LT(section.furthest, 0.25);         // of an edge
  }
}

// The straight section has 0.1 by 0.12 m, and the tetrahedra there edges of 0.018 m.
TEST(SolidCut, parts_a_notched_bar_in_a_smooth_section) {
  const double straight = 0.1 * 0.12;
  for (const double turned : {0.0, 30.0}) {
    const auto [section, fragments] = parted_bar(turned);
    EXPECT_EQ(fragments, 2u);
    EXPECT_LT(section.area, 1.25 * straight);
    EXPECT_GT(section.area, straight);
    EXPECT_LT(section.furthest, 0.018);
  }
}

} // namespace
} // namespace rend::solid_cut_test
