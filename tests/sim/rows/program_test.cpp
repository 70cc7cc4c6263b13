// Flat arrays = walking the map, one thread = many, and what a separation must not change.
#include "sim/brute_force.h"
#include "sim/presets.h"
#include "sim/rows/walk_forces.h"
#include "sim/house_rules/house_rules.h"
#include "sim/rules/apply.h"
#include "sim/topology/walk.h"

#include <gtest/gtest.h>

#include <cstring>

namespace rend::program_test {
namespace {

using namespace meshes;

const std::string small_steps = R"(<time step="5e-4" integrator="verlet" duration="1"/>)";
const std::string pull = R"(<fix side="+z"/><drive side="-z" velocity="0.3 0 -1"/>)";

// Displaces vertices out of the plane, so that hinges are active.
void crumple(Body& body, double amount) {
  Noise noise(1);
  for (Record& x : body.map->position().values()) x.y += amount * noise();
}

const std::string provot = R"(<bend kind="provot" k="10"/>)";
const std::string angular = R"(<bend kind="angular" k="0.01" damping="1e-5"/>)";
const std::string global_law = R"(<tear criterion="global-border" threshold="0.02"/>)";
const std::string atomic_law = R"(<tear criterion="atomic-border" threshold="0.03"/>)";

// The largest difference of the program's forces from those of a walk, for the body's state.
double difference_from_walk(const Body& body) {
  const std::size_t vertices = body.program->vertices(), corners = body.map->cells(VertexOfFace).slots();
  std::vector<Record> flat(vertices), walk(vertices), corner(corners), walk_corner(corners);
  body.program->forces(positions(body), velocities(body), flat.data());
  walk_forces(*body.map, body.interactions, body.mass->orbit(), positions(body), velocities(body),
              walk_corner.data(), walk.data());
  double most = difference(flat, walk);
  if (!body.program->elementary().empty()) {
    body.program->corner_forces(positions(body), velocities(body), corner.data(), flat.data());
    most = std::max({most, difference(flat, walk), difference(corner, walk_corner)});
  }
  return most;
}

TEST(Program, gives_the_forces_of_a_walk_all_along_a_run_that_tears) {
  for (const std::string pattern : {"quads", "crossed", "mixed", "triangles"}) {
    for (const std::string& bend : {provot, angular}) {
      for (const std::string& law : {global_law, atomic_law}) {
        SCOPED_TRACE(pattern + bend + law);
        presets::Loaded scene = presets::load(presets::cloth(pattern, 6, law, small_steps, bend, pull));
        crumple(scene.body(), 3e-3);
        for (int n = 0; n < 500; ++n) {
          scene->step();
          ASSERT_LT(difference_from_walk(scene.body()), 1e-12) << "after step " << n;
        }
        EXPECT_GT(scene->tears(), 5u);
      }
    }
  }
}

TEST(Program, gives_the_forces_of_a_walk_and_of_the_polygons_on_torn_sheets_of_every_kind) {
  for (const Named& sheet : irregular()) {
    SCOPED_TRACE(sheet.name);
    Recipe recipe;
    recipe.springs = all_springs(0.5);
    recipe.criteria = {"atomic-border"};
    recipe.scheme = "rk4";
    const auto body = meshes::body(sheet.mesh, recipe);
    Noise noise(3);
    const std::size_t darts = body->map->map().capacity();
    for (int n = 0; n < 30; ++n) {
      body->map->edit([&](Edit& edit) { unsew(edit, 2, Dart{noise.below(darts)}); });
      body->rebind();
      shake(*body, 0.2, 100 + n);
      ASSERT_LT(difference_from_walk(*body), 1e-12) << "after edit " << n;
      BruteForce brute(*body->map);
      brute.look_at(*body);
      for (const Spring& spring : recipe.springs) brute.add(spring);
      std::vector<Record> f(body->program->vertices());
      body->program->forces(positions(*body), velocities(*body), f.data());
      ASSERT_LT(difference(f, brute.forces(*body)), 1e-12) << "after edit " << n;
    }
  }
}

std::uint64_t hash_after(const std::string& xml, int steps, int threads, int parts, std::size_t& tears) {
  presets::Loaded scene = presets::load(xml, {.walk = false, .threads = threads});
  EXPECT_EQ(scene.body().program->parts(), parts);
  crumple(scene.body(), 1e-4);
  for (int n = 0; n < steps; ++n) scene->step();
  tears = scene->tears();
  return scene->hash();
}

TEST(Program, gives_the_same_bytes_on_one_two_and_four_threads_while_it_tears) {
  const std::string weak = R"(<bend kind="angular" k="1e-4" damping="1e-8"/>)"; // cells are small
  for (const std::string pattern : {"quads", "crossed"}) {
    for (const std::string& bend : {provot, weak}) {
      const std::string xml =
          presets::cloth(pattern, 64, R"(<tear criterion="global-border" threshold="0.1"/>)",
                         R"(<time step="2e-5" integrator="rk4" duration="1"/>)", bend,
                         R"(<drive side="-x" velocity="-8 0 0"/><fix side="+x"/>)");
      std::size_t torn = 0, torn_two = 0, torn_four = 0;
      const std::uint64_t one = hash_after(xml, 40, 1, 1, torn);
      EXPECT_EQ(hash_after(xml, 40, 2, 2, torn_two), one) << pattern << bend;
      EXPECT_EQ(hash_after(xml, 40, 4, 4, torn_four), one) << pattern << bend;
      EXPECT_GT(torn, 20u) << pattern << bend;
      EXPECT_EQ(torn_two, torn);
      EXPECT_EQ(torn_four, torn);
    }
  }
}

TEST(Program, runs_small_bodies_on_one_thread) {
  EXPECT_EQ(presets::load(presets::cloth("quads", 10), {.walk = false, .threads = 4}).body().program->parts(),
            1);
}

// ---- what a separation must not change

struct Snapshot {
  double mass = 0;
  Vec3 momentum;
  std::vector<Vec3> position, velocity, rest; // of every dart
};
Snapshot snapshot(const Body& body) {
  Snapshot s{total_mass(*body.map, *body.mass), total_momentum(*body.map, *body.mass), {}, {}, {}};
  body.map->map().for_each_dart([&](Dart d) {
    const Slot v = body.map->vertex(d);
    s.position.push_back(body.map->position()[v].vec());
    s.velocity.push_back(body.map->velocity()[v].vec());
    s.rest.push_back(body.map->rest()[v].vec());
  });
  return s;
}

TEST(Separation, keeps_mass_momentum_and_every_dart_to_the_last_bit) {
  for (const Named& sheet : irregular()) {
    SCOPED_TRACE(sheet.name);
    Recipe recipe;
    recipe.drag = 0.2;
    const auto body = meshes::body(sheet.mesh, recipe);
    shake(*body, 0.2, 9);
    const Snapshot before = snapshot(*body);
    const std::size_t darts = body->map->map().capacity(), vertices = body->map->cells(Vertex).count();
    for (std::size_t n = 0; n < darts; n += 1 + n % 3) {
      body->map->edit([&](Edit& edit) { unsew(edit, 2, Dart{n}); });
      body->program->rebind();
      const Snapshot after = snapshot(*body);
      ASSERT_EQ(after.mass, before.mass);
      ASSERT_EQ(after.momentum, before.momentum);
      ASSERT_EQ(after.position, before.position);
      ASSERT_EQ(after.velocity, before.velocity);
      ASSERT_EQ(after.rest, before.rest);
    }
    EXPECT_GT(body->map->cells(Vertex).count(), vertices);
  }
}

TEST(Separation, shares_the_drag_of_a_vertex_among_its_fragments) {
  Recipe recipe;
  recipe.drag = 0.2;
  const auto body = meshes::body(sheet(SheetPattern::Quads, 4, 4), recipe);
  const auto all_drag = [&] {
    double sum = 0;
    for (Slot v = 0; v < body->program->vertices(); ++v)
      if (body->program->inverse_mass()[v] > 0)
        sum += body->program->drag_rate()[v] / body->program->inverse_mass()[v];
    return sum;
  };
  EXPECT_NEAR(all_drag(), 25 * 0.2, 1e-12);
  for (std::uint32_t n = 0; n < 60; ++n) body->map->edit([&](Edit& edit) { unsew(edit, 2, Dart{2 * n}); });
  body->program->rebind();
  EXPECT_GT(body->map->cells(Vertex).count(), 30u);
  EXPECT_NEAR(all_drag(), 25 * 0.2, 1e-12);
}

} // namespace
} // namespace rend::program_test
