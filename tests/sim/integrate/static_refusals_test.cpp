// What the static solve refuses, and what it does not, where little or nothing holds the body.
#include "sim/integrate/solved_scenes.h"

#include "sim/build/build_scene.h"
#include "sim/elements.h"
#include "sim/ground_springs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rend::static_refusals_test {
namespace {

using namespace solved;
using testing::HasSubstr;

TEST(StaticSolve, refuses_what_nothing_holds) {
  const auto refusal = [](const std::string& more, const std::string& springs) {
    const auto s = presets::load(scene(R"(<body><sheet cells="4 3" size="1 1"/><mass total="1"/><springs>)" +
                                           springs + "</springs>" + more + "</body>",
                                       "static", 1, 1));
    try {
      s->step();
    } catch (const Unstable& error) {
      EXPECT_EQ(error.code, Exit::Unstable);
      EXPECT_EQ(s->steps_done(), 0);
      return std::string(error.what()) + " | " + error.hint;
    }
    return std::string("not refused");
  };
  const std::string springs =
      R"(<stretch k="100"/><shear kind="isotropic" k="50"/><bend kind="provot" k="50"/>)";
  EXPECT_THAT(refusal("", springs), HasSubstr("a piece of 20 vertices is free to move along x, y, z"));
  EXPECT_THAT(refusal(R"(<fix all="yes" axes="xy"/>)", springs), HasSubstr("along z"));
  EXPECT_THAT(refusal(R"(<fix near="0 0 0"/>)", springs),
              testing::AnyOf(HasSubstr("turn"), HasSubstr("not refused")));
}

// A bar of hexahedra along x, a metre long, under its weight.
presets::Loaded heavy_bar(const std::string& pattern, const std::string& model, double density,
                          const std::string& held) {
  return presets::load(
      scene(fmt::format(R"(<body><bar pattern="{}" cells="6 2 2" size="1 0.2 0.2"/><mass density="{}"/>)"
                        R"(<elasticity model="{}" young="1e5"/>{}</body>)",
                        pattern, density, model, held),
            "static", 1, 1));
}

std::string refusal_of_step(const presets::Loaded& s) {
  try {
    s->step();
  } catch (const Unstable& error) {
    EXPECT_EQ(static_cast<int>(error.code), 76);
    return std::string(error.what()) + " | " + error.hint;
  }
  return "not refused";
}

// Held at a point it may turn: no model of small displacements has an equilibrium, wherever the solve gets to.
TEST(StaticSolve, refuses_small_displacements_of_what_may_turn) {
  for (const char* model : {"linear", "mass-tensor"})
    for (const char* pattern : {"hexahedra", "prisms", "tetrahedra", "mixed"})
      EXPECT_THAT(refusal_of_step(heavy_bar(pattern, model, 1000, R"(<fix near="0 0 0"/>)")),
                  HasSubstr("can turn as a whole"))
          << model << ", " << pattern;
  EXPECT_EQ(refusal_of_step(heavy_bar("hexahedra", "linear", 1, R"(<fix side="-x"/>)")), "not refused");
}

// What turns with its elements hangs below the point, its weight on the line through it; or it is refused.
TEST(StaticSolve, hangs_a_bar_from_its_corner_or_refuses) {
  for (const char* pattern : {"hexahedra", "prisms", "tetrahedra", "mixed"}) {
    const auto s = heavy_bar(pattern, "corotational", 100, R"(<fix near="0 0 0"/>)");
    const std::string refusal = refusal_of_step(s);
    if (refusal != "not refused") {
      EXPECT_THAT(refusal, HasSubstr("no equilibrium was found")) << pattern;
      continue;
    }
    Vec3 moment = Vec3::Zero();
    double mass = 0;
    for (Slot v = 0; v < s.body().vertices(); ++v) {
      const double m = 1 / s.body().program->inverse_mass()[v];
      moment += m * s.body().map->position()[v].vec();
      mass += m;
    }
    // Elements with one mean rotation leave a moment of their own (element_law.h): they hang a little off.
    const double off = std::string(pattern) == "tetrahedra" ? 1e-6 : 5e-3;
    EXPECT_NEAR(moment.x() / mass, 0, off) << pattern;
    EXPECT_NEAR(moment.y() / mass, 0, off) << pattern;
    EXPECT_LT(moment.z() / mass, -0.4) << pattern;
  }
}

TEST(StaticSolve, refuses_forces_that_overflow) {
  EXPECT_THAT(refusal_of_step(heavy_bar("hexahedra", "corotational", 1000,
                                        R"(<fix side="-x"/><load side="+x" force="1e300 0 0"/>)")),
              HasSubstr("the forces overflow"));
}

// A sheet of 1 kg under its weight with nothing fixed, and springs to the ground at every vertex; `springs`:
// its own.
Scene anchored(std::unique_ptr<Interaction> (*make)(EmbeddedMap&), bool springs) {
  BodySettings sheet;
  sheet.shape = SheetShape{.pattern = SheetPattern::Mixed, .nx = 4, .ny = 3, .size = {{1, 1}}};
  sheet.place = Placement{.rotate = {20, 10, 0}};
  sheet.mass.total = 1;
  if (springs)
    sheet.springs = SpringsSettings{.springs = {{.type = find_interaction("stretch"), .k = 200},
                                                {.type = find_interaction("bend", "angular"), .k = 0.1}}};
  SceneDefinition scene;
  scene.time = TimeSettings{.step = 1, .scheme = find_scheme("static"), .duration = 1};
  Body& body = add_body(scene, sheet);
  body.interactions.push_back(make(*body.map));
  return {std::move(scene), {}};
}

TEST(StaticSolve, takes_springs_to_the_ground_for_a_hold) {
  constexpr double k = 30, g = 9.81;
  for (const bool springs : {false, true}) {
    Scene scene = anchored([](EmbeddedMap& map) { return ground::springs(map, k); }, springs);
    scene.step();
    const Body& body = *scene.bodies()[0];
    Vec3 carried = Vec3::Zero();
    for (Slot v = 0; v < body.vertices(); ++v) {
      const Vec3 sinks = body.map->position()[v].vec() - body.map->rest()[v].vec();
      carried += k * sinks;
      if (!springs) {
        EXPECT_NEAR((sinks - Vec3(0, 0, -g / (k * body.program->inverse_mass()[v]))).norm(), 0, 1e-9) << v;
      }
    }
    EXPECT_NEAR((carried - Vec3(0, 0, -g)).norm(), 0, 1e-6)
        << "they carry the weight of 1 kg, and nothing else does";
  }
}

TEST(StaticSolve, refuses_what_springs_to_the_ground_let_slide) {
  Scene scene = anchored([](EmbeddedMap& map) { return ground::springs(map, 30, 0, Vec3(0, 0, 1)); }, true);
  try {
    scene.step();
    FAIL() << "not refused";
  } catch (const Unstable& error) {
    EXPECT_THAT(error.what(), HasSubstr("is free to move along x, y"));
  }
}

} // namespace
} // namespace rend::static_refusals_test
