// Bodies and scenes that a program makes of structs, without a preset: bit for bit those of the preset that
// says the same.
#include "sim/build/build_scene.h"

#include "render/picture/scene_preset.h"
#include "sim/scene/scene.h"
#include "sim/shipped_presets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rend::settings_test {
namespace {

using testing::HasSubstr;

// presets/showcase/flag.xml, but for how it is drawn.
SceneDefinition flag_of_structs() {
  BodySettings flag;
  flag.name = "flag";
  flag.shape = SheetShape{.pattern = SheetPattern::Crossed, .nx = 36, .ny = 24, .size = {{1.5, 1}}};
  flag.place = Placement{.rotate = {90, 0, 0}, .translate = {-0.7, 0, 0.9}};
  flag.mass.total = 0.25;
  flag.springs = SpringsSettings{.springs = {{.type = find_interaction("bend", "angular"), .k = 4e-5}}};
  flag.elasticity = ElasticitySettings{.model = ContinuumModel::Corotational,
                                       .young = 2e5,
                                       .poisson = 0.3,
                                       .thickness = 1e-3,
                                       .damping_mass = 0.2,
                                       .damping_stiffness = 1e-5};
  flag.motions = {FixSettings{.where = {.side = "-x"}}};
  flag.tears = {LawSettings{
      .criterion = find_criterion("vertex-stress"), .threshold = 5.2e4, .change = find_change("cut")}};
  flag.contact = ContactSettings{.floor = true, .obstacles = false, .friction = 0.6};

  SceneDefinition scene;
  scene.name = "flag";
  scene.world.floor = Floor{.z = 0};
  scene.world.boxes = {Box{.low = {-0.725, -0.012, 0}, .high = {-0.701, 0.012, 1.96}}};
  scene.world.wind = Wind{.velocity = {12, 2.4, 1.2}, .drag = 0.7};
  scene.time.duration = 4;
  add_body(scene, flag);
  return scene;
}

// presets/tear/table-7.1-mixed-atomic.xml.
SceneDefinition cloth_of_structs() {
  BodySettings cloth;
  cloth.name = "cloth";
  cloth.shape = SheetShape{.pattern = SheetPattern::Mixed, .nx = 10, .ny = 10, .size = {{1, 1}}};
  cloth.place.translate = {0, 0, 1.5};
  cloth.mass.total = 0.1;
  cloth.springs = SpringsSettings{.springs = {{.type = find_interaction("stretch"), .k = 60},
                                              {.type = find_interaction("shear", "isotropic"), .k = 43},
                                              {.type = find_interaction("bend", "provot"), .k = 10}}};
  cloth.viscosity = ViscositySettings{.value = 0.1, .per = ViscositySettings::Per::Body};
  cloth.motions = {FixSettings{.where = {.near = Vec3(0, 1, 1.5)}},
                   FixSettings{.where = {.near = Vec3(1, 1, 1.5)}}};
  cloth.tears = {LawSettings{.criterion = find_criterion("atomic-border"), .threshold = 0.5}};
  cloth.contact = ContactSettings{.floor = true, .obstacles = false};

  SceneDefinition scene;
  scene.name = "table-7.1-mixed-atomic";
  scene.world.floor = Floor{.z = 0};
  scene.time = TimeSettings{.step = 1e-3, .scheme = find_scheme("rk4"), .duration = 2};
  add_body(scene, cloth);
  return scene;
}

// presets/tear/ripped-corners.xml, but for how it is drawn.
SceneDefinition rag_of_structs() {
  BodySettings rag;
  rag.name = "cloth";
  rag.shape = SheetShape{.pattern = SheetPattern::Mixed, .nx = 15, .ny = 15, .size = {{1, 1}}};
  rag.place = Placement{.rotate = {90, 0, 0}, .translate = {-0.5, 0, 0.3}};
  rag.mass.total = 0.15;
  rag.elasticity = ElasticitySettings{.young = 2e5, .thickness = 1e-3, .damping_stiffness = 3e-4};
  rag.springs =
      SpringsSettings{.springs = {{.type = find_interaction("bend", "angular"), .k = 1e-3, .damping = 2e-5}}};
  rag.viscosity = ViscositySettings{.value = 0.15, .per = ViscositySettings::Per::Body};
  rag.motions = {
      DriveSettings{
          .where = {.box = {{-0.51, -1, 1.2, -0.09, 1, 1.31}}}, .velocity = Vec3(-0.2, -0.06, 0), .until = 2.8},
      DriveSettings{
          .where = {.box = {{0.09, -1, 1.2, 0.51, 1, 1.31}}}, .velocity = Vec3(0.2, 0.06, 0), .until = 2.8}};
  rag.tears = {LawSettings{
      .criterion = find_criterion("vertex-stress"), .threshold = 2.5e4, .change = find_change("split-vertex")}};
  rag.contact = ContactSettings{.floor = true, .obstacles = false, .thickness = 0.004};

  SceneDefinition scene;
  scene.name = "ripped-corners";
  scene.world.floor = Floor{.z = 0};
  scene.time = TimeSettings{.step = 3.3e-4, .duration = 3.8};
  add_body(scene, rag);
  return scene;
}

// presets/verify/cantilever-tip-load.xml.
SceneDefinition cantilever_of_structs() {
  BodySettings beam;
  beam.name = "beam";
  beam.shape = BarShape{.nx = 160, .ny = 1, .nz = 2, .size = {1, 0.05, 0.1}};
  beam.mass.density = 1000;
  beam.elasticity = ElasticitySettings{.model = ContinuumModel::Linear, .young = 1e7, .poisson = 0};
  beam.motions = {FixSettings{.where = {.side = "-x"}}};
  beam.loads = {LoadSettings{.where = {.side = "+x"}, .force = Vec3(0, 0, -0.1)}};
  beam.probes = {{.name = "tip", .where = {.side = "+x"}}, {.name = "wall", .where = {.side = "-x"}}};
  beam.answers = {{.probe = "tip", .quantity = "dz", .value = -8.048e-4, .tolerance = 5e-3},
                  {.probe = "wall", .quantity = "reaction-z", .value = 0.1, .tolerance = 1e-6}};

  SceneDefinition scene;
  scene.name = "cantilever-tip-load";
  scene.world.gravity = Vec3::Zero();
  scene.time = TimeSettings{.step = 1, .scheme = find_scheme("static"), .duration = 1};
  add_body(scene, beam);
  return scene;
}

// The steps of both, with the same bits after each of them.
void expect_same(const std::string& name, SceneDefinition of_structs, int steps, std::size_t least_tears) {
  const auto preset = load_scene(shipped::path_of(name));
  Scene read(read_scene(*preset), {}), made(std::move(of_structs), {});
  EXPECT_EQ(made.name(), read.name());
  EXPECT_EQ(made.duration(), read.duration());
  EXPECT_EQ(made.step_size(), read.step_size());
  EXPECT_EQ(made.notes(), read.notes());
  EXPECT_EQ(made.bodies()[0]->notes, read.bodies()[0]->notes);
  EXPECT_EQ(made.bodies()[0]->left_out, read.bodies()[0]->left_out);
  for (int n = 0; n < steps; ++n) {
    ASSERT_EQ(made.hash(), read.hash()) << "after " << n << " steps";
    read.step();
    made.step();
  }
  EXPECT_EQ(made.hash(), read.hash());
  EXPECT_EQ(made.tears(), read.tears());
  EXPECT_GE(made.tears(), least_tears) << "the test steps on until something tears";
}

TEST(Settings, of_a_cloth_that_tears_make_what_its_preset_makes) {
  expect_same("tear/table-7.1-mixed-atomic", cloth_of_structs(), 200, 1);
}

TEST(Settings, of_a_driven_rag_make_what_its_preset_makes) {
  expect_same("tear/ripped-corners", rag_of_structs(), 250, 1);
}

TEST(Settings, of_a_flag_in_the_wind_make_what_its_preset_makes) {
  expect_same("showcase/flag", flag_of_structs(), 30, 0);
}

TEST(Settings, of_a_solid_make_what_its_preset_makes) {
  expect_same("verify/cantilever-tip-load", cantilever_of_structs(), 1, 0);
  Scene scene(cantilever_of_structs(), {});
  scene.step();
  for (const Answer& answer : scene.bodies()[0]->answers) EXPECT_TRUE(answer.holds()) << answer.error();
}

// Why a body of these settings is refused; empty: it is not.
std::string refusal_of(const BodySettings& settings, SceneDefinition scene = {}) {
  try {
    add_body(scene, settings);
  } catch (const UserError& error) {
    return error.what();
  }
  return {};
}

BodySettings sheet_settings() {
  BodySettings body;
  body.shape = SheetShape{.nx = 2, .ny = 2, .size = {{1, 1}}};
  body.mass.total = 1;
  return body;
}

TEST(Settings, that_no_reader_has_looked_at_are_checked_as_a_reader_would) {
  EXPECT_EQ(refusal_of(sheet_settings()), "");
  BodySettings body = sheet_settings();
  body.mass.total = -1;
  EXPECT_EQ(refusal_of(body), "total is -1; expected a number above 0 and at most 1e+30 [kg]");
  body = sheet_settings();
  body.mass.total = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal_of(body), HasSubstr("total is nan"));
  body = sheet_settings();
  body.shape = SheetShape{.nx = 0, .size = {{1, 1}}};
  EXPECT_THAT(refusal_of(body), HasSubstr("cells is 0; expected 2 whole numbers"));
  body = sheet_settings();
  body.motions = {FixSettings{.where = {.side = "left"}}};
  EXPECT_THAT(refusal_of(body), HasSubstr("side is 'left'; expected one of -x, +x"));
  body = sheet_settings();
  body.motions = {DriveSettings{.where = {.all = true}}};
  EXPECT_THAT(refusal_of(body), HasSubstr("needs one of velocity, displacement, gradient, rotate"));
  body = sheet_settings();
  body.tears = {LawSettings{.criterion = find_criterion("strian"), .threshold = 1}};
  EXPECT_THAT(refusal_of(body), HasSubstr("criterion is missing; expected one of atomic-spring"));
  body = sheet_settings();
  body.springs = SpringsSettings{.springs = {{.type = find_interaction("strech"), .k = 1}}};
  EXPECT_THAT(refusal_of(body), HasSubstr("there is no such spring"));
}

TEST(Settings, of_two_bodies_or_two_probes_of_one_name_are_refused) {
  SceneDefinition scene;
  BodySettings body = sheet_settings();
  body.probes = {{.name = "tip", .where = {.side = "+x"}}};
  add_body(scene, body);
  EXPECT_EQ(refusal_of(body, std::move(scene)), "two bodies are called 'body'");
  body.probes.push_back({.name = "tip", .where = {.side = "-x"}});
  EXPECT_EQ(refusal_of(body), "two probes are called 'tip'");
}

TEST(Settings, of_time_need_a_duration_and_a_scheme) {
  const auto refusal = [](const TimeSettings& time) -> std::string {
    SceneDefinition scene;
    scene.time = time;
    add_body(scene, sheet_settings());
    try {
      Scene(std::move(scene), {});
    } catch (const UserError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(refusal({.step = 1e-3, .duration = 1}), "");
  EXPECT_EQ(refusal({.step = 1e-3}), "<time> needs duration");
  EXPECT_THAT(refusal({.step = 1e-3, .scheme = find_scheme("eulre"), .duration = 1}),
              HasSubstr("integrator is missing"));
  EXPECT_THAT(refusal({.step = 1e-3, .tolerance = 1e-3, .duration = 1}),
              HasSubstr("tolerance is used by rk45 alone"));
}

TEST(Settings, have_the_defaults_that_the_table_of_parameters_tells) {
  const auto fallback = [](const auto& attributes, const std::string& name) {
    for (const AttributeType& type : attributes)
      if (type.name == name) return type.fallback.value_or("none");
    return std::string("no such attribute");
  };
  EXPECT_EQ(fallback(attributes_of<ContactSettings>(), "with"), "obstacles");
  EXPECT_EQ(fallback(attributes_of<ContactSettings>(), "thickness"), "0.002");
  EXPECT_EQ(fallback(attributes_of<DriveSettings>(), "until"), "none");
  EXPECT_EQ(fallback(attributes_of<DriveSettings>(), "then"), "hold");
  EXPECT_EQ(fallback(attributes_of<AnswerSettings>(), "at"), "end");
  EXPECT_EQ(fallback(attributes_of<TimeSettings>(), "step"), "auto");
  EXPECT_EQ(fallback(attributes_of<TimeSettings>(), "integrator"), "symplectic");
  EXPECT_EQ(fallback(attributes_of<TimeSettings>(), "tolerance"), "1e-6");
  EXPECT_EQ(fallback(attributes_of<World>(), "gravity"), "0 0 -9.81");
  EXPECT_EQ(fallback(attributes_of<Selector>(), "all"), "none");
}

} // namespace
} // namespace rend::settings_test
