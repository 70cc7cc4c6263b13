// Wind against its formula, and the terminal velocity in still air.
#include "sim/outside/wind.h"

#include "sim/mesh/bar.h"
#include "sim/presets.h"
#include "sim/random_meshes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rend::wind_test {
namespace {

Vec3 total(const EmbeddedMap& map, const WindLoad& wind) {
  std::vector<Record> f(map.cells(Vertex).slots());
  wind.add(map.position().values().data(), map.velocity().values().data(), f.data());
  Vec3 sum = Vec3::Zero();
  for (const Record& each : f) sum += each.vec();
  return sum;
}

TEST(Wind, pushes_a_flat_plate_by_the_square_of_its_normal_speed) {
  for (SheetPattern pattern : {SheetPattern::Quads, SheetPattern::Triangles, SheetPattern::Mixed}) {
    const auto map = sheet_from(meshes::sheet(pattern, 4, 3));
    EXPECT_NEAR((total(*map, {*map, {Vec3(5, 1, 3), 0.7}}) - Vec3(0, 0, 0.7 * 12 * 9)).norm(), 0, 1e-12);
    EXPECT_NEAR((total(*map, {*map, {Vec3(5, 1, -3), 0.7}}) + Vec3(0, 0, 0.7 * 12 * 9)).norm(), 0, 1e-12);
    for (Record& v : map->velocity().values()) v = Record(1, 2, 5);
    EXPECT_NEAR((total(*map, {*map, {Vec3(5, 1, 3), 0.7}}) + Vec3(0, 0, 0.7 * 12 * 4)).norm(), 0, 1e-12);
  }
}

TEST(Wind, blows_on_the_windward_faces_of_a_solid_alone) {
  const auto map = solid_from(bar_cells({BarPattern::Mixed, 4, 2, 2, Vec3(4, 1, 2)}));
  const Vec3 expected = 0.5 * Vec3(9 * 2, -16 * 8, 0); // +x sees an area of 1 × 2, −y of 4 × 2
  EXPECT_NEAR((total(*map, {*map, {Vec3(3, -4, 0), 0.5}}) - expected).norm(), 0, 1e-12);
}

TEST(Wind, has_no_force_on_what_moves_with_it) {
  const auto map = sheet_from(meshes::irregular()[3].mesh);
  for (Record& v : map->velocity().values()) v = Record(5, 1, 3);
  EXPECT_NEAR(total(*map, {*map, {Vec3(5, 1, 3), 0.7}}).norm(), 0, 1e-13);
}

// m v' = m g − drag A v²: v = w tanh(g t/w), w = √(m g/(drag A)). All corners of a sheet of one quad fall
// alike.
TEST(Wind, lets_a_sheet_fall_up_to_its_terminal_speed) {
  for (const char* scheme : {"rk4", "verlet", "midpoint"}) {
    const auto scene = presets::load(R"(<scene><body><sheet cells="1 1" size="2 1"/><mass total="0.5"/></body>
      <world><wind velocity="0 0 0" drag="0.6"/></world>
      <time step="0.001" duration="3" integrator=")" +
                                     std::string(scheme) + R"("/></scene>)");
    const double terminal = std::sqrt(0.5 * 9.81 / (0.6 * 2));
    for (int n = 0; n < 200; ++n) scene->step();
    EXPECT_NEAR(scene.body().map->velocity()[0].z, -terminal * std::tanh(9.81 * 0.2 / terminal), 1e-5)
        << scheme;
    for (int n = 0; n < 2800; ++n) scene->step();
    EXPECT_NEAR(scene.body().map->velocity()[0].z, -terminal, 1e-9) << scheme;
  }
}

// A light sheet fixed in a strong wind: its faces are damped by 2 drag w A/m = 2400/s.
TEST(Wind, is_seen_by_the_automatic_step) {
  const auto scene = presets::load(R"(<scene><body><sheet cells="2 2" size="1 1"/><mass total="0.02"/></body>
    <world gravity="0 0 0"><wind velocity="0 0 40"/></world>
    <time step="auto" duration="1" integrator="symplectic"/></scene>)");
  EXPECT_NEAR(scene->step_size(), 0.9 * 2 / 2400, 1e-6);
  for (int n = 0; n < 1000; ++n) scene->step();
  EXPECT_NEAR(scene.body().map->velocity()[0].z, 40, 1);
}

TEST(Wind, blows_on_as_a_sheet_tears) {
  const auto scene = presets::load(R"(<scene><body><sheet cells="6 6" size="1 1"/><mass total="0.1"/>
    <springs><stretch k="60"/><shear k="40"/></springs><viscosity value="0.1" per="body"/><fix side="-x"/>
    <tear criterion="global-border" threshold="0.4"/></body>
    <world gravity="0 0 0"><wind velocity="2 0 8"/></world>
    <time step="0.002" duration="1" integrator="rk4"/></scene>)");
  for (int n = 0; n < 200; ++n) scene->step();
  EXPECT_GT(scene->tears(), 5u);
  EXPECT_GT(scene->momentum().z(), 0);
}

} // namespace
} // namespace rend::wind_test
