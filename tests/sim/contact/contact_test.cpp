// Contact with the floor, against Coulomb's law.
#include "sim/outside/contact_settings.h"

#include "sim/presets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rend::contact_test {
namespace {

constexpr double thickness = 0.002;

// A sheet on the floor with an initial tangential velocity.
presets::Loaded sliding(const std::string& friction, const std::string& integrator) {
  return presets::load(
      R"(<scene><body><sheet cells="3 3" size="1 1"/><place translate="0 0 0.002"/><mass total="0.1"/>
      <springs><stretch k="60"/></springs><drive all="yes" velocity="1 0.5 0" until="0.0105" then="free"/>
      <contact friction=")" +
      friction + R"("/></body><world><floor z="0"/></world>
      <time step="1e-3" integrator=")" +
      integrator + R"(" duration="1"/></scene>)");
}

Vec3 velocity(const presets::Loaded& scene, Slot v) {
  return scene.body().map->velocity()[v];
}

TEST(FloorContact, slows_a_sliding_sheet_by_friction_times_its_weight) {
  for (const char* integrator : {"symplectic", "verlet", "midpoint", "rk4", "explicit"}) {
    const auto scene = sliding("0.3", integrator);
    for (int n = 0; n < 100; ++n) scene->step();
    const double speed = std::hypot(1.0, 0.5), left = speed - 0.3 * 9.81 * 0.09;
    for (Slot v = 0; v < 16; ++v) {
      EXPECT_NEAR(velocity(scene, v).norm(), left, 0.3 * 9.81 * 2e-3) << integrator;
      EXPECT_NEAR(velocity(scene, v).y() / velocity(scene, v).x(), 0.5, 1e-9) << integrator;
    }
  }
}

TEST(FloorContact, stops_it_and_does_not_turn_it_around) {
  const auto scene = sliding("0.8", "symplectic");
  for (int n = 0; n < 400; ++n) scene->step();
  for (Slot v = 0; v < 16; ++v) EXPECT_LT(velocity(scene, v).norm(), 1e-14);
}

TEST(FloorContact, without_friction_keeps_its_speed) {
  const auto scene = sliding("0", "symplectic");
  for (int n = 0; n < 400; ++n) scene->step();
  for (Slot v = 0; v < 16; ++v) EXPECT_NEAR((velocity(scene, v) - Vec3(1, 0.5, 0)).norm(), 0, 1e-12);
}

TEST(FloorContact, keeps_a_falling_cloth_above_the_floor) {
  for (const char* integrator : {"symplectic", "verlet", "rk4"}) {
    const auto scene = presets::load(std::string(R"(<scene><body><sheet pattern="mixed" cells="8 8" size="1 1"/>
        <place rotate="60 20 0" translate="0 0 0.5"/><mass total="0.1"/>
        <springs><stretch k="60" damping="0.01"/><shear k="40"/><bend kind="provot" k="5"/></springs>
        <viscosity value="0.1" per="body"/><contact/></body><world><floor z="0.1"/></world>
        <time step="auto" integrator=")") +
                                     integrator + R"(" duration="2"/></scene>)");
    bool touched = false;
    while (scene->time() < 1.5) {
      scene->step();
      for (Slot v = 0; v < scene.body().vertices(); ++v) {
        const double z = scene.body().map->position()[v].z;
        ASSERT_GE(z, 0.1 + thickness - 1e-12) << integrator;
        touched = touched || z < 0.1 + thickness + 1e-12;
      }
    }
    EXPECT_TRUE(touched) << integrator;
  }
}

TEST(FloorContact, lets_prescribed_vertices_pass) {
  const auto scene = presets::load(R"(<scene><body><sheet cells="2 2" size="1 1"/><place translate="0 0 0.11"/>
      <mass total="0.1"/><springs><stretch k="60"/></springs><fix near="0 0 0"/>
      <drive near="1 1 0" velocity="0 0 -1"/>
      <contact/></body><world><floor z="0.1"/></world><time step="1e-3" duration="1"/></scene>)");
  for (int n = 0; n < 100; ++n) scene->step();
  const EmbeddedMap& map = *scene.body().map;
  for (Slot v = 0; v < 9; ++v) {
    const Vec3 rest = map.rest()[v];
    const double expected = rest == Vec3(0, 0, 0.11) ? 0.11 : rest == Vec3(1, 1, 0.11) ? 0.01 : 0;
    if (expected == 0) {
      EXPECT_GE(map.position()[v].z, 0.1 + thickness - 1e-12);
    } else {
      EXPECT_NEAR(map.position()[v].z, expected, 1e-15);
    }
  }
}

TEST(FloorContact, is_left_out_where_nobody_asked_for_it) {
  const std::string sheet = R"(<sheet cells="1 1" size="1 1"/><mass total="1"/>)",
                    time = R"(<time step="0.01" duration="1"/>)";
  const auto falls =
      presets::load("<scene><body>" + sheet + R"(</body><world><floor z="-0.1"/></world>)" + time + "</scene>");
  for (int n = 0; n < 100; ++n) falls->step();
  EXPECT_LT(falls.body().map->position()[0].z, -4);
  EXPECT_FALSE(falls.body().floor_contact);
  EXPECT_THAT(falls.body().left_out, testing::Contains(testing::HasSubstr("will pass through")));
  EXPECT_THROW(presets::load("<scene><body>" + sheet + "<contact/></body>" + time + "</scene>"), UserError);
}

} // namespace
} // namespace rend::contact_test
