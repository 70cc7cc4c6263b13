// A scene that is stored and restored continues bit for bit: every shipped preset, torn or not.
//
// By default up to its first tears and a little further; with REND_WHOLE in the environment each clip is stored
// seven times (tests/run --all).
#include "render/picture/scene_preset.h"
#include "sim/base/archive.h"
#include "sim/build/build_scene.h"
#include "sim/mesh_files.h"
#include "sim/presets.h"
#include "sim/random_meshes.h"
#include "sim/scene/scene.h"
#include "sim/shipped_presets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace rend::store_test {
namespace {

std::vector<std::uint8_t> stored(Scene& scene) {
  Archive archive;
  scene.store(archive);
  return archive.bytes();
}

void restore(Scene& scene, const std::vector<std::uint8_t>& bytes) {
  Archive archive{std::span<const std::uint8_t>(bytes)};
  scene.store(archive);
  archive.end();
}

// The stored bytes without measured run times.
std::vector<std::uint8_t> timeless(const std::vector<std::uint8_t>& bytes) {
  const std::string mark = "seconds";
  const auto at = std::find_end(bytes.begin(), bytes.end(), mark.begin(), mark.end());
  return {bytes.begin(), at};
}

struct StoredRun {
  std::unique_ptr<PresetNode> preset;
  std::unique_ptr<Scene> scene;
  explicit StoredRun(const std::string& name)
      : preset(load_scene(shipped::path_of(name))),
        scene(std::make_unique<Scene>(read_scene(*preset, scene_pictures()),
                                      SceneOptions{.threads = 2, .count_fragments = true})) {}
};

void expect_same(Scene& a, Scene& b) {
  EXPECT_EQ(a.hash(), b.hash());
  EXPECT_EQ(a.tears(), b.tears());
  EXPECT_EQ(a.evaluations(), b.evaluations());
  EXPECT_EQ(a.kinetic_energy(), b.kinetic_energy());
  EXPECT_EQ(a.elastic_energy(), b.elastic_energy());
  EXPECT_TRUE(timeless(stored(a)) == timeless(stored(b))) << "at step " << a.steps_done();
}

void go(Scene& scene, long steps) {
  const long end = scene.steps_done() + steps;
  while (scene.steps_done() < end) scene.step();
}

class StoredPreset : public testing::TestWithParam<std::string> {};

TEST_P(StoredPreset, goes_on_to_the_bit) {
  StoredRun first(GetParam()), other(GetParam());
  Scene& scene = *first.scene;
  const bool whole = std::getenv("REND_WHOLE") != nullptr;
  const long all = static_cast<long>(scene.duration() / scene.step_size());
  std::size_t vertices = 0;
  for (const auto& body : scene.bodies()) vertices += body->vertices();
  const long affordable = static_cast<long>(4'000'000 / std::max<std::size_t>(vertices, 1000));
  const long last = whole ? all : std::min(all, affordable);
  go(scene, std::min<long>(last, 20));
  for (int part = 1; part <= (whole ? 7 : 1) && !HasFailure(); ++part) {
    const long until = last * part / (whole ? 8 : 1) - 20;
    while (scene.steps_done() < until && (whole || scene.tears() == 0)) scene.step();
    const auto bytes = stored(scene);
    restore(*other.scene, bytes); // into a scene with another state
    EXPECT_TRUE(stored(*other.scene) == bytes);
    for (std::size_t n = 0; n < scene.bodies().size(); ++n)
      EXPECT_TRUE(scene.bodies()[n]->program->same_as(*other.scene->bodies()[n]->program));
    go(scene, 20);
    go(*other.scene, 20);
    expect_same(scene, *other.scene);
  }
}

INSTANTIATE_TEST_SUITE_P(All, StoredPreset, testing::ValuesIn(shipped::all_presets()), shipped::as_word);

// Within the crack, steps are divided by bounds that are kept from tear to tear.
TEST(Store, a_scene_goes_on_from_within_a_crack_that_is_cut) {
  for (const char* name : {"tear/notched-strip-cut", "fracture/notched-bar-cut"}) {
    StoredRun first(name), other(name);
    for (std::size_t tears : {1, 4, 12}) {
      while (first.scene->tears() < tears && first.scene->time() < first.scene->duration()) first.scene->step();
      restore(*other.scene, stored(*first.scene));
      const std::size_t before = first.scene->tears();
      for (int n = 0; n < 4000 && first.scene->tears() < before + 4; n += 20) {
        go(*first.scene, 20);
        go(*other.scene, 20);
      }
      EXPECT_GE(first.scene->tears(), before + 4) << name;
      expect_same(*first.scene, *other.scene);
    }
  }
}

// A sheet that is cut while it is pulled; then its loose half is thrown back by a mesh that moves.
std::string struck_crack() {
  const std::string ram = mesh_files::box("crack-ram.obj", {0.3, -0.05, -0.02}, {0.34, 0.06, 0.14});
  return R"(<scene><body><sheet pattern="triangles" cells="8 5" corners="0 0 0  0.2 0 0  0.2 0 0.12  0 0 0.12"/>
      <slit along="0.09 0 -0.01  0.09 0 0.03"/><mass density="1000" thickness="0.001"/>
      <elasticity model="corotational" young="2e4" poisson="0.3" thickness="0.001" damping-stiffness="1e-3"/>
      <fix side="-x"/><drive side="+x" velocity="0.4 0 0" until="0.06" then="free"/>
      <tear criterion="vertex-stress" threshold="1.5e3" change="cut" max-per-step="1"/>
      <contact with="obstacles self" thickness="0.002"/></body>
      <world gravity="0 1 -3"><obstacle file=")" +
         ram + R"(" velocity="-0.7 0 0"/></world>
      <time integrator="symplectic" step="auto" duration="0.4"/></scene>)";
}

TEST(Store, a_scene_goes_on_from_within_a_crack_whose_sides_touch_again) {
  const std::string xml = struck_crack();
  const auto one = presets::load(xml), other = presets::load(xml);
  std::size_t before = 0;
  for (const double time : {0.04, 0.05, 0.1, 0.2}) {
    while (one->time() < time) one->step();
    restore(*other.scene, stored(*one.scene));
    go(*one.scene, 100);
    go(*other.scene, 100);
    expect_same(*one.scene, *other.scene);
    before = std::max(before, one->tears());
  }
  EXPECT_GT(before, 3u);
  EXPECT_TRUE(one.body().work_meter->touched(one->world().number_of_mesh(0)));
  EXPECT_GT(one->contacts()->torn_sides()->pairs(), 2u);
}

TEST(Store, a_scene_goes_on_from_any_step_with_every_scheme) {
  for (const Scheme& scheme : all_schemes()) {
    const std::string time = R"(<time step="1e-3" integrator=")" + scheme.name + R"(" duration="1"/>)";
    const std::string xml = presets::cloth(
        "quads", 4, R"(<tear criterion="global-border" threshold="0.3" max-per-step="1"/>)", time);
    const auto one = presets::load(xml);
    int compared = 0;
    try {
      for (; compared < 12; ++compared) {
        const auto other = presets::load(xml);
        restore(*other.scene, stored(*one.scene));
        go(*one.scene, 1);
        go(*other.scene, 1);
        expect_same(*one.scene, *other.scene);
      }
    } catch (const Unstable&) { // static may not converge on a cloth that tears
      EXPECT_EQ(scheme.name, "static");
    }
    EXPECT_GE(compared, scheme.name == "static" ? 1 : 12) << scheme.name;
  }
}

bool slots_in_order_of_darts(const EmbeddedMap& map) {
  const CellIndex& vertices = map.cells(Vertex);
  for (Slot v = 0; v + 1 < vertices.slots(); ++v)
    if (vertices.first_dart(v + 1) < vertices.first_dart(v)) return false;
  return true;
}

// Random edges of a displaced cloth are separated, until its vertices are renumbered (embedding/reorder.h).
TEST(Store, a_scene_goes_on_to_the_bit_across_the_step_that_numbers_vertices_anew) {
  const std::string xml =
      presets::cloth("quads", 91, R"(<tear criterion="global-border" threshold="1e-9" max-per-step="100"/>)",
                     R"(<time step="2e-5" integrator="symplectic" duration="1"/>)");
  const auto one = presets::load(xml), other = presets::load(xml), third = presets::load(xml);
  meshes::Noise noise(1);
  for (Record& x : one.body().map->position().values()) x = Record(x.vec() + 1e-3 * noise.vector());
  std::vector<std::uint8_t> before;
  bool anew = false;
  while (!anew && one.scene->steps_done() < 400) {
    if (one.scene->steps_done() % 10 == 0) before = stored(*one.scene);
    go(*one.scene, 1);
    anew = one.body().vertices() > 9000 && slots_in_order_of_darts(*one.body().map);
  }
  ASSERT_TRUE(anew) << one.body().vertices() << " vertices after " << one.scene->tears() << " tears";
  EXPECT_EQ(validate(*one.body().map), std::nullopt);
  restore(*other.scene, before);
  go(*other.scene, one.scene->steps_done() - other.scene->steps_done());
  expect_same(*one.scene, *other.scene);
  restore(*third.scene, stored(*one.scene));
  EXPECT_TRUE(third.body().program->same_as(*one.body().program));
  go(*one.scene, 5);
  go(*third.scene, 5);
  expect_same(*one.scene, *third.scene);
}

TEST(Store, refuses_what_was_of_another_scene) {
  const auto a = presets::load(presets::cloth("quads", 4)), b = presets::load(presets::cloth("quads", 5)),
             tearing = presets::load(
                 presets::cloth("quads", 4, R"(<tear criterion="global-border" threshold="0.3"/>)"));
  EXPECT_THROW(restore(*tearing.scene, stored(*a.scene)), ArchiveError);
  auto bytes = stored(*b.scene);
  bytes.resize(bytes.size() - 1);
  EXPECT_THROW(restore(*b.scene, bytes), ArchiveError) << "one byte is missing";
  bytes = stored(*a.scene);
  bytes.push_back(0);
  EXPECT_THROW(restore(*a.scene, bytes), ArchiveError) << "one byte too many";
}

} // namespace
} // namespace rend::store_test
