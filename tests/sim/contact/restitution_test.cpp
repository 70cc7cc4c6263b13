// Restitution, against the height h to which something rises that fell from h: e² h.
#include "sim/contact/contact_names.h"

#include "sim/presets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace rend::restitution_test {
namespace {

constexpr double step = 1e-4, speed = 4.43; // [s]; [m/s], after a fall from 1 m
const std::string aside = R"(<body name="aside"><sheet cells="1 1" size="0.1 0.1"/><place translate="9 9 9"/>
    <mass total="1"/><springs><stretch k="1"/></springs><fix all="yes"/></body>)";

std::string time_of(const std::string& integrator) {
  return "<time step=\"1e-4\" duration=\"9\" integrator=\"" + integrator + "\"/></scene>";
}

// The largest height after the first impact, of what `height` [m] tells, until it falls again.
template <class Height> double rebound(const presets::Loaded& scene, const Height& height) {
  double before = height(), now = before;
  const auto go = [&] {
    scene->step();
    before = now;
    now = height();
  };
  do go();
  while (now < before);
  do go();
  while (now > before);
  return before;
}

double height_of_sphere(const presets::Loaded& scene) {
  return scene->world().spheres[0].centre.z() - scene->world().spheres[0].radius;
}

double mean_height(const presets::Loaded& scene) {
  double sum = 0, all = 0;
  const Body& body = scene.body();
  for (Slot v = 0; v < body.vertices(); ++v, ++all) sum += body.map->position()[v].z;
  return sum / all;
}

presets::Loaded sphere_over_floor(double e, const std::string& integrator) {
  return presets::load("<scene>" + aside + R"(<world><floor z="0" restitution=")" + std::to_string(e) +
                       R"("/><sphere centre="0 0 1.1" radius="0.1" mass="2"/></world>)" + time_of(integrator));
}

TEST(Restitution, a_sphere_rises_to_its_square_times_the_height) {
  for (const char* integrator : {"symplectic", "verlet", "rk4"})
    for (const double e : {0.3, 0.8, 1.0}) {
      const auto scene = sphere_over_floor(e, integrator);
      EXPECT_NEAR(rebound(scene, [&] { return height_of_sphere(scene); }), e * e, 2 * speed * step)
          << integrator << " " << e;
    }
}

presets::Loaded flat_sheet_over_floor(const std::string& contact, const std::string& integrator) {
  return presets::load(R"(<scene><body><sheet cells="3 3" size="0.3 0.3"/><place translate="0 0 1.002"/>
      <mass total="0.1"/><springs><stretch k="60"/></springs>)" +
                       contact + R"(</body><world><floor z="0" name="ground"/></world>)" + time_of(integrator));
}

TEST(Restitution, a_sheet_that_falls_flat_rises_to_its_square_times_the_height) {
  for (const char* integrator : {"symplectic", "verlet", "rk4", "rk45"})
    for (const double e : {0.0, 0.5, 0.9}) {
      const auto scene =
          flat_sheet_over_floor("<contact restitution=\"" + std::to_string(e) + "\"/>", integrator);
      EXPECT_NEAR(rebound(scene, [&] { return mean_height(scene); }) - 0.002, e * e, 2 * speed * step)
          << integrator << " " << e;
    }
}

TEST(Restitution, of_a_named_pair_counts_before_that_of_the_body) {
  const auto scene = flat_sheet_over_floor(
      R"(<contact restitution="0.9"/><contact with="ground" restitution="0.4"/>)", "symplectic");
  EXPECT_NEAR(rebound(scene, [&] { return mean_height(scene); }) - 0.002, 0.16, 2 * speed * step);
}

// A block in which elasticity is as stiff as young says, 0.1 m above the floor.
presets::Loaded block(double young, double e) {
  return presets::load(R"(<scene><body><bar pattern="hexahedra" cells="2 2 2" size="0.2 0.2 0.2"/>
      <place translate="0 0 0.102"/><mass total="8"/><elasticity model="corotational" poisson="0.3" young=")" +
                       std::to_string(young) + R"("/><contact restitution=")" + std::to_string(e) +
                       R"("/></body><world><floor z="0"/></world>)" + time_of("symplectic"));
}

// Of a solid those vertices strike that are below; what the others do is up to its elasticity.
TEST(Restitution, of_a_block_is_that_of_its_vertices_that_strike) {
  for (const double young : {2e4, 1e6}) {
    const auto scene = block(young, 0.6);
    const Body& body = scene.body();
    std::vector<Record> before;
    do {
      before = body.map->velocity().values();
      scene->step();
    } while (!body.work_meter->work().contact.touched);
    int struck = 0;
    for (Slot v = 0; v < body.vertices(); ++v) {
      if (body.map->rest()[v].z > 0.103) continue;
      ++struck;
      EXPECT_NEAR(body.map->velocity()[v].z, -0.6 * before[v].z, 1e-9) << young;
    }
    EXPECT_EQ(struck, 9);
  }
}

TEST(Restitution, a_block_of_either_material_rises_no_higher_than_it_fell) {
  for (const double young : {2e4, 1e6})
    for (const double e : {0.0, 0.5, 1.0}) {
      const auto scene = block(young, e);
      const double start = mean_height(scene);
      double highest = 0;
      for (int n = 0; n < 6000; ++n) {
        scene->step();
        if (n > 1500) highest = std::max(highest, mean_height(scene));
      }
      EXPECT_LT(highest, start) << young << " " << e;
      const EnergyFigures energy = scene->energy();
      EXPECT_LT(energy.gained, 1e-3 * energy.scale) << young << " " << e;
    }
}

TEST(Restitution, what_bounces_comes_to_rest_once_it_strikes_with_less_than_two_steps_of_gravity) {
  const auto scene = sphere_over_floor(0.5, "symplectic");
  for (int n = 0; n < 20000; ++n) scene->step();
  EXPECT_LT(scene->world().spheres[0].velocity.norm(), 1e-12);
  EXPECT_NEAR(height_of_sphere(scene), 0, 1e-12);
}

TEST(Restitution, of_spheres_that_meet_turns_their_approach_around) {
  const auto scene = presets::load("<scene>" + aside + R"(<world gravity="0 0 0">
      <sphere centre="0 0 0" radius="0.1" mass="1" velocity="1 0 0" restitution="0.7"/>
      <sphere centre="0.5 0 0" radius="0.1" mass="3"/></world>)" +
                                   time_of("symplectic"));
  for (int n = 0; n < 5000; ++n) scene->step();
  const auto& spheres = scene->world().spheres;
  EXPECT_NEAR(spheres[1].velocity.x() - spheres[0].velocity.x(), 0.7, 1e-12);
  EXPECT_NEAR(spheres[0].velocity.x() + 3 * spheres[1].velocity.x(), 1, 1e-12);
}

} // namespace
} // namespace rend::restitution_test
