// Fused sweeps, which compute forces while vertices are integrated, give the same bytes as steps that compute
// all forces first.
//
// Small bodies split into parts (SceneOptions) never use sweeps: they are the reference.
#include "render/picture/scene_preset.h"
#include "sim/build/build_scene.h"
#include "sim/presets.h"
#include "sim/scene/scene.h"
#include "sim/shipped_presets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <mutex>

namespace rend::sweep_test {
namespace {

bool sweeps(const Scene& scene) {
  return std::any_of(scene.bodies().begin(), scene.bodies().end(),
                     [](const auto& body) { return body->may_defer_forces(); });
}

void expect_same_sweep(const Scene& swept, const Scene& asked) {
  EXPECT_EQ(swept.hash(), asked.hash());
  EXPECT_EQ(swept.kinetic_energy(), asked.kinetic_energy());
  for (std::size_t b = 0; b < swept.bodies().size(); ++b) {
    const Body &one = *swept.bodies()[b], &other = *asked.bodies()[b];
    EXPECT_EQ(std::memcmp(one.force.data(), other.force.data(), one.force.size() * sizeof(Record)), 0);
    EXPECT_EQ(one.next.motion(), other.next.motion());
    EXPECT_EQ(one.evaluations, other.evaluations);
  }
}

TEST(SweptSteps, of_every_preset_gives_the_bytes_of_forces_first) {
  int swept = 0;
  for (const std::string& name : shipped::all_presets()) {
    SCOPED_TRACE(name);
    const auto preset = load_scene(shipped::path_of(name));
    Scene one(read_scene(*preset, scene_pictures()), SceneOptions{.threads = 1});
    if (!sweeps(one)) continue;
    ++swept;
    const auto again = load_scene(shipped::path_of(name));
    Scene other(read_scene(*again, scene_pictures()),
                SceneOptions{.threads = 1, .parallel_small_bodies = true});
    EXPECT_FALSE(sweeps(other));
    for (int n = 0; n < 40; ++n) {
      one.step();
      other.step();
    }
    expect_same_sweep(one, other);
  }
  EXPECT_GT(swept, 5);
}

// 40,401 vertices: five tiles.
TEST(SweptSteps, of_many_tiles_gives_the_same_bytes_on_any_number_of_threads) {
  const std::string xml =
      presets::cloth("crossed", 200, "", R"(<time step="1e-5" integrator="symplectic" duration="1"/>)");
  presets::Loaded asked = presets::load(xml, {.threads = 1, .parallel_small_bodies = true});
  for (int n = 0; n < 20; ++n) asked->step();
  for (const int threads : {1, 2, 3}) {
    SCOPED_TRACE(threads);
    presets::Loaded swept = presets::load(xml, {.threads = threads});
    EXPECT_TRUE(sweeps(*swept.scene));
    for (int n = 0; n < 20; ++n) swept->step();
    expect_same_sweep(*swept.scene, *asked.scene);
  }
}

// A step that is too long, which the guard divides into substeps.
TEST(SweptSteps, under_the_guard_gives_the_same_bytes) {
  const auto run = [](bool parallel_ranges) {
    presets::Loaded scene = presets::load(
        presets::cloth("quads", 12, "", R"(<time step="4e-3" integrator="symplectic" duration="10"/>)"),
        {.threads = 1, .parallel_small_bodies = parallel_ranges});
    for (int n = 0; n < 150; ++n) scene->step();
    return scene;
  };
  const presets::Loaded swept = run(false), asked = run(true);
  EXPECT_GT(swept->guard().redone, 0);
  EXPECT_EQ(swept->guard().redone, asked->guard().redone);
  EXPECT_EQ(swept->hash(), asked->hash());
}

TEST(SweptSteps, tells_of_each_vertex_once_when_its_force_is_whole) {
  constexpr std::size_t unit = 512;
  presets::Loaded scene = presets::load(
      presets::cloth("quads", 150, "", R"(<time step="1e-5" integrator="symplectic" duration="1"/>)"),
      {.threads = 3});
  const Body& body = scene.body();
  const Record *x = body.map->position().values().data(), *v = body.map->velocity().values().data();
  std::vector<Record> all(body.vertices()), force(body.vertices()), seen(body.vertices());
  std::vector<int> times(body.vertices());
  std::mutex mutex;
  std::size_t calls = 0;
  body.program->forces(x, v, all.data());
  body.program->forces_in_ranges(x, v, force.data(), unit, [&](std::size_t begin, std::size_t end) {
    const std::lock_guard lock(mutex);
    ++calls;
    for (std::size_t i = begin; i < end; ++i) {
      ++times[i];
      seen[i] = force[i];
    }
  });
  EXPECT_GT(calls, 3u);
  EXPECT_EQ(std::count(times.begin(), times.end(), 1), static_cast<long>(times.size()));
  EXPECT_EQ(std::memcmp(seen.data(), all.data(), all.size() * sizeof(Record)), 0);
}

} // namespace
} // namespace rend::sweep_test
