// The two sides of a crack, in a solid and in a sheet: they do not turn through each other while they still
// hang together, part freely, and keep momentum.
#include "sim/contact/torn_sides.h"

#include "sim/mechanics/interaction.h"
#include "sim/presets.h"
#include "sim/topology/count.h"
#include "sim/topology/walk.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace rend::torn_sides_test {
namespace {

const std::string none, fragments = R"(<contact with="fragments" thickness="0.004" friction="0.3"/>)";

// Two cells along x, 0.1 m each, and `high` of them along z.
presets::Loaded blocks(const std::string& contact, int high = 1) {
  return presets::load(fmt::format(
      R"(<scene><body><bar pattern="hexahedra" cells="2 1 {}" size="0.2 0.1 {}"/><mass density="1000"/>
         <elasticity model="corotational" young="2e4" poisson="0.3" damping-stiffness="1e-3"/>
         <tear criterion="atomic-border" threshold="1e9" change="separate"/>{}</body>
         <world gravity="0 0 0"/><time integrator="symplectic" step="5e-4" duration="1"/></scene>)",
      high, 0.1 * high, contact));
}

// Those of a sheet that stands upright.
presets::Loaded squares(const std::string& contact, int high = 1) {
  return presets::load(fmt::format(
      R"(<scene><body><sheet cells="2 {}" corners="0 0 0  0.2 0 0  0.2 0 {}  0 0 {}"/>
         <mass density="1000" thickness="0.001"/>
         <elasticity model="corotational" young="2e4" poisson="0.3" thickness="0.001" damping-stiffness="1e-3"/>
         <tear criterion="atomic-border" threshold="1e9" change="separate"/>{}</body>
         <world gravity="0 0 0"/><time integrator="symplectic" step="5e-4" duration="1"/></scene>)",
      high, 0.1 * high, 0.1 * high, contact));
}

constexpr auto both = {&blocks, &squares};

// Parts what lies on either side of x = 0.1 above z = `above`.
void tear(Body& body, double above = 0) {
  EmbeddedMap& map = *body.map;
  const int n = map.dimension();
  const auto middle = [&](Orbit of, Dart d) {
    Vec3 sum = Vec3::Zero();
    const std::vector<Dart> cell = darts_of(map.map(), of, d);
    for (Dart e : cell) sum += map.rest_of(e);
    return Vec3(sum / static_cast<double>(cell.size()));
  };
  const Orbit element = n == 3 ? Volume : Face, side = n == 3 ? FaceOfVolume : EdgeOfFace;
  std::vector<Dart> darts;
  map.map().for_each_dart([&](Dart d) {
    const Dart e = map.map().alpha(n, d);
    const bool between = d < e && (middle(element, d).x() < 0.1) != (middle(element, e).x() < 0.1);
    if (between && middle(side, d).z() > above) darts.push_back(d);
  });
  map.edit([&](Edit& edit) {
    for (Dart d : darts)
      if (!map.map().is_free(n, d)) unsew(edit, n, d);
  });
  body.rebind();
}

// Whether a vertex is one of the left half.
std::vector<bool> left_vertices(const Body& body) {
  std::vector<bool> left;
  const CellIndex& vertices = body.map->cells(Vertex);
  const Orbit element = body.map->dimension() == 3 ? Volume : Face;
  for (Slot v = 0; v < vertices.slots(); ++v) {
    double most = -1e300;
    for (Dart d : darts_of(body.map->map(), Vertex, vertices.first_dart(v)))
      for (Dart e : darts_of(body.map->map(), element, d)) most = std::max(most, body.map->rest_of(e).x());
    left.push_back(most < 0.15);
  }
  return left;
}

// Sets velocities: those of the left half, and of the right one with x turned around; of z in [0.1, 0.2] the
// higher the faster if `turning`.
void push(const presets::Loaded& scene, const Vec3& velocity, bool turning = false) {
  const std::vector<bool> left = left_vertices(scene.body());
  const auto& rest = scene.body().map->rest();
  Record* v = scene.body().map->velocity().values().data();
  for (Slot n = 0; n < left.size(); ++n) {
    const double share = turning ? (rest[n].z - 0.1) / 0.1 : 1;
    v[n] = Record(share * (left[n] ? 1 : -1) * velocity.x(), share * velocity.y(), share * velocity.z());
  }
}

// [m]: between the two vertices of each corner that has been torn, the least.
double opening(const presets::Loaded& scene) {
  const std::vector<bool> left = left_vertices(scene.body());
  const auto& rest = scene.body().map->rest();
  const auto& x = scene.body().map->position();
  double least = 1e300;
  for (Slot a = 0; a < left.size(); ++a)
    for (Slot b = 0; b < left.size(); ++b)
      if (left[a] && !left[b] && rest[a].vec() == rest[b].vec()) least = std::min(least, x[b].x - x[a].x);
  return least;
}

double least_opening(const presets::Loaded& scene, int steps) {
  double least = 1e300;
  for (int n = 0; n < steps; ++n) {
    scene->step();
    least = std::min(least, opening(scene));
  }
  return least;
}

constexpr double touches = -1e-9; // [m]

TEST(TornSides, that_are_pushed_together_again_do_not_pass_nor_stick) {
  for (const auto make : both) {
    const auto scene = make(fragments, 1);
    tear(scene.body());
    push(scene, {0.5, 0, 0});
    EXPECT_GT(least_opening(scene, 200), touches);
    push(scene, {-0.5, 0, 0});
    const double energy = scene->kinetic_energy();
    const double before = opening(scene);
    EXPECT_GT(least_opening(scene, 100), touches);
    EXPECT_LE(scene->kinetic_energy(), energy + 1);
    EXPECT_GT(opening(scene), before + 0.03) << "they part freely";
  }
}

TEST(TornSides, do_not_turn_through_each_other_about_the_tip_of_the_crack) {
  for (const auto make : both) {
    const auto with = make(fragments, 2), without = make(none, 2);
    for (const presets::Loaded* each : {&with, &without}) {
      const presets::Loaded& scene = *each;
      tear(scene.body(), 0.1);
      EXPECT_EQ(count_cells(scene.body().map->map()).fragments, 1u);
      push(scene, {0.5, 0, 0}, true);
    }
    const Vec3 momentum = with->momentum();
    EXPECT_GT(least_opening(with, 100), touches);
    EXPECT_EQ(with->contacts()->torn_sides()->pairs(), 1u);
    EXPECT_LT((with->momentum() - momentum).norm(), 1e-12);
    EXPECT_LT(least_opening(without, 100), -0.005) << "this is what contact is for";
  }
}

TEST(TornSides, that_hang_together_open_as_if_there_were_no_contact) {
  for (const auto make : both) {
    const auto with = make(fragments, 2), without = make(none, 2);
    for (const presets::Loaded* each : {&with, &without}) {
      const presets::Loaded& scene = *each;
      tear(scene.body(), 0.1);
      push(scene, {-0.5, 0, 0}, true);
      for (int n = 0; n < 40; ++n) scene->step();
    }
    EXPECT_GT(opening(with), 0.005);
    EXPECT_EQ(opening(with), opening(without));
  }
}

TEST(TornSides, that_slide_along_each_other_keep_their_momentum_and_make_no_energy) {
  const auto scene = blocks(fragments, 2);
  tear(scene.body(), 0.1);
  push(scene, {0.4, 0.3, 0.1}, true);
  const Vec3 momentum = scene->momentum();
  const double energy = scene->kinetic_energy();
  for (int n = 0; n < 200; ++n) {
    scene->step();
    EXPECT_LE(scene->kinetic_energy() + scene->elastic_energy(), 1.01 * energy);
  }
  EXPECT_LT((scene->momentum() - momentum).norm(), 1e-12);
}

// Two halves of a sheet, one in front of the other by more than the thickness: it may cover the other.
TEST(TornSides, of_sheets_that_lie_on_each_other_are_not_pushed_apart_along_them) {
  const auto scene = squares(fragments);
  tear(scene.body());
  const std::vector<bool> left = left_vertices(scene.body());
  Record* x = scene.body().map->position().values().data();
  for (Slot n = 0; n < left.size(); ++n)
    if (left[n]) x[n].y += 0.005;
  push(scene, {0.5, 0, 0});
  EXPECT_LT(least_opening(scene, 60), -0.025);
}

// A sheet of triangles that stands upright, 0.2 x 0.1 m, `more` of it.
presets::Loaded triangles(const std::string& more, const std::string& contact) {
  return presets::load(
      R"(<scene><body><sheet pattern="triangles" cells="8 4" corners="0 0 0  0.2 0 0  0.2 0 0.1  0 0 0.1"/>
         <mass density="1000" thickness="0.001"/>
         <elasticity model="corotational" young="2e4" poisson="0.3" thickness="0.001"
          damping-stiffness="1e-3"/>)" +
      more + contact +
      R"(</body><world gravity="0 0 0"/><time integrator="symplectic" step="2e-4" duration="1"/></scene>)");
}

// [m]: how deep a vertex is within a face that does not have it, at most, in the plane of the sheet.
double overlap(const Body& body) {
  const auto& x = body.map->position();
  std::vector<std::array<Slot, 3>> faces;
  for_each_face(*body.map, [&](Dart first) {
    faces.push_back({});
    Dart d = first;
    for (Slot& corner : faces.back()) {
      corner = body.map->vertex(d);
      d = body.map->map().alpha(1, body.map->map().alpha(0, d));
    }
  });
  double most = 0;
  for (const auto& face : faces)
    for (Slot v = 0; v < body.vertices(); ++v) {
      if (v == face[0] || v == face[1] || v == face[2]) continue;
      double depth = 1e300;
      const auto across = [&](Slot a, Slot b, Slot c) { // from the side a b
        return ((x[b].x - x[a].x) * (x[c].z - x[a].z) - (x[b].z - x[a].z) * (x[c].x - x[a].x)) /
               std::hypot(x[b].x - x[a].x, x[b].z - x[a].z);
      };
      const double turn = across(face[0], face[1], face[2]) > 0 ? 1 : -1;
      for (std::size_t k = 0; k < 3; ++k) depth = std::min(depth, turn * across(face[k], face[(k + 1) % 3], v));
      most = std::max(most, depth);
    }
  return most;
}

double most_overlap(const presets::Loaded& scene, int steps) {
  double most = 0;
  for (int n = 0; n < steps; ++n) {
    scene->step();
    most = std::max(most, overlap(scene.body()));
  }
  return most;
}

// Each end goes towards the other [m/s].
void press(const presets::Loaded& scene, double speed) {
  const auto& rest = scene.body().map->rest();
  Record* v = scene.body().map->velocity().values().data();
  for (Slot n = 0; n < scene.body().vertices(); ++n) v[n] = Record(rest[n].x < 0.1 ? speed : -speed, 0, 0);
}

TEST(TornSides, of_a_slit_do_not_pass_when_they_are_pushed_together) {
  for (const char* along :
       {"0.095 0 -0.01  0.105 0 0.11", "0.07 0 -0.01  0.13 0 0.11", "0.13 0 -0.01  0.08 0 0.06"}) {
    const std::string slit = fmt::format(R"(<slit along="{}"/>)", along);
    const auto with = triangles(slit, fragments), without = triangles(slit, none);
    for (const presets::Loaded* scene : {&with, &without}) press(*scene, 0.3);
    EXPECT_LT(most_overlap(with, 200), 2e-4) << along;
    EXPECT_GT(most_overlap(without, 200), 5e-4) << along;
  }
}

TEST(TornSides, of_a_crack_that_was_cut_do_not_pass_when_they_are_pushed_together) {
  const std::string cuts = R"(<slit along="0.09 0 -0.01  0.09 0 0.03"/>
      <tear criterion="vertex-stress" threshold="2e3" change="cut"/>)";
  const auto with = triangles(cuts, fragments), without = triangles(cuts, none);
  for (const presets::Loaded* each : {&with, &without}) {
    const presets::Loaded& scene = *each;
    press(scene, -0.5);
    for (int n = 0; n < 300 && count_cells(scene.body().map->map()).fragments < 2; ++n) scene->step();
    EXPECT_EQ(count_cells(scene.body().map->map()).fragments, 2u);
    press(scene, 0.5);
  }
  EXPECT_LT(most_overlap(with, 300), 1e-4);
  EXPECT_GT(with->contacts()->torn_sides()->pairs(), 3u);
  EXPECT_GT(most_overlap(without, 300), 2e-3);
}

TEST(TornSides, cost_nothing_where_nothing_has_torn) {
  const auto whole = blocks(fragments);
  whole->step();
  EXPECT_EQ(whole->contacts()->torn_sides()->bytes(), 0u);
  const auto sheet = presets::load(
      R"(<scene><body><sheet cells="2 2" size="1 1"/><mass total="1"/><springs><stretch k="10"/></springs>)" +
      fragments + R"(</body><world gravity="0 0 0"/><time step="1e-3" duration="1"/></scene>)");
  sheet->step();
  EXPECT_EQ(sheet->contacts()->torn_sides()->bytes(), 0u);
}

} // namespace
} // namespace rend::torn_sides_test
