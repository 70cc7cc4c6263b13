// Scenes whose bodies lose their last element: all that depends on a body must handle an empty one.
#include "sim/body/measure.h"
#include "sim/fracture/torn_bodies.h"
#include "sim/presets.h"

#include <gtest/gtest.h>

namespace rend::gone_test {
namespace {

std::string scene_of(const std::string& shape, const std::string& matter, const std::string& time) {
  return R"(<scene name="gone">
            <world gravity="0 0 -9.81"><floor z="-1"/><wind velocity="2 0 0" drag="0.6"/></world>
            <body name="it">)" +
         shape + matter + R"(<viscosity value="0.1" per="body"/><fix side="-x"/>
            <load side="+x" force="0 0 -0.1"/><contact/><probe name="end" side="+x"/></body>
            <body name="other"><sheet cells="2 2" size="1 1"/><mass total="0.1"/>
            <springs><stretch k="60"/></springs></body>)" +
         time + "</scene>";
}

// Deletes random elements from the start.
presets::Loaded loaded(const std::string& xml, const SceneOptions& options = {}) {
  presets::Loaded scene = presets::load(xml, options);
  Body& body = scene.body();
  LawSettings law;
  law.criterion = &torn::chance<Cell::Elements>();
  law.change = &torn::change("delete-element");
  law.cell = Cell::Elements;
  body.tear_laws.emplace_back(body.request_for(law), law);
  return scene;
}

const std::vector<std::pair<std::string, std::string>>& bodies() {
  static const std::vector<std::pair<std::string, std::string>> all{
      {R"(<sheet pattern="mixed" cells="4 3" size="1 1"/>)",
       R"(<mass total="0.1"/><springs><stretch k="60"/><bend kind="angular" k="0.01"/></springs>)"},
      {R"(<bar pattern="mixed" cells="4 1 1" size="1 1 1"/>)",
       R"(<mass total="1"/><elasticity model="corotational" young="1e4" poisson="0.3"/>)"}};
  return all;
}

TEST(Gone, a_body_without_elements_is_held_loaded_blown_at_and_measured_all_the_same) {
  for (const auto& [shape, matter] : bodies()) {
    for (const char* scheme : {"symplectic", "verlet", "rk4", "implicit"}) {
      SCOPED_TRACE(shape + scheme);
      const std::string time = std::string(R"(<time step="1e-3" duration="1" integrator=")") + scheme + "\"/>";
      presets::Loaded scene = loaded(scene_of(shape, matter, time), {.count_fragments = true});
      Body& body = scene.body();
      const double other = total_mass(*scene.body(1).map, *scene.body(1).mass);
      for (int n = 0; n < 300 && !body.deleted_at; ++n) scene->step();
      ASSERT_TRUE(body.deleted_at);
      for (int n = 0; n < 40; ++n) scene->step();
      scene->check_sound();
      EXPECT_NEAR(*body.deleted_at, body.events.back().time, 0);
      EXPECT_EQ(body.events.back().fragments, 0);
      EXPECT_EQ(scene->mass(), other);
      EXPECT_TRUE(std::isfinite(scene->kinetic_energy() + scene->elastic_energy() + scene->gravity_energy()));
      EXPECT_TRUE(scene->momentum().allFinite());
      EXPECT_EQ(body.probes[0].read(body), std::nullopt);
      for (const auto& values : {vertex_strain(body), vertex_force(body), vertex_stress(body)})
        for (double value : values) EXPECT_EQ(value, 0);
    }
  }
}

TEST(Gone, walking_the_map_of_an_emptied_body_finds_no_forces) {
  for (const auto& [shape, matter] : bodies()) {
    presets::Loaded scene =
        loaded(scene_of(shape, matter, R"(<time step="1e-3" duration="1"/>)"), {.walk = true});
    for (int n = 0; n < 300 && !scene.body().deleted_at; ++n) scene->step();
    ASSERT_TRUE(scene.body().deleted_at);
    scene->step();
    for (const Record& f : scene.body().force) EXPECT_EQ(f.vec().norm(), 0);
  }
}

TEST(ForceLaw, on_a_body_that_is_wholly_fixed_is_noted) {
  const auto notes = [](const std::string& motion) {
    presets::Loaded scene = presets::load(R"(<scene name="s"><body name="b"><sheet cells="2 2" size="1 1"/>)"
                                          R"(<mass total="0.1"/><springs><stretch k="60"/></springs>)" +
                                          motion + R"(<tear criterion="global-border" threshold="1"/></body>)" +
                                          R"(<time step="1e-3" duration="1"/></scene>)");
    scene->step();
    std::string all;
    for (const std::string& note : scene.body().notes) all += note;
    return all;
  };
  EXPECT_NE(notes(R"(<fix all="yes"/>)").find("every vertex is fixed"), std::string::npos);
  EXPECT_EQ(notes(R"(<fix side="-x"/>)").find("every vertex is fixed"), std::string::npos);
  EXPECT_EQ(notes(R"(<fix all="yes" axes="xy"/>)").find("every vertex is fixed"), std::string::npos);
  EXPECT_EQ(notes(R"(<drive all="yes" velocity="1 0 0"/>)").find("every vertex is fixed"), std::string::npos);
}

} // namespace
} // namespace rend::gone_test
