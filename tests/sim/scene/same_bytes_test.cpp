// Every shipped preset gives the same bytes for any number of threads, and with incremental updates or rebuilds
// from scratch after a change of the map.
//
// Small bodies, which otherwise run on one thread, are split into parts as well. By default only the first
// steps are run; presets with tearing laws up to their first tears if that is cheap; with REND_WHOLE in the
// environment whole clips (tests/run --all). Vector units: tests/render/commands/presets_test.cpp; builds and
// other processors: tests/same-states.
#include "render/picture/scene_preset.h"
#include "sim/build/build_scene.h"
#include "sim/scene/scene.h"
#include "sim/shipped_presets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace rend::same_bytes_test {
namespace {

struct Played {
  std::unique_ptr<PresetNode> preset;
  Scene scene;
  Played(const std::string& name, int threads)
      : preset(load_scene(shipped::path_of(name))),
        scene(read_scene(*preset, scene_pictures()),
              SceneOptions{.threads = threads, .parallel_small_bodies = true}) {}
  long steps() const { return static_cast<long>(scene.duration() / scene.step_size()); }
  void go_to(long step) {
    while (scene.steps_done() < step) scene.step();
  }
  bool has_laws() const {
    return std::any_of(scene.bodies().begin(), scene.bodies().end(),
                       [](const auto& body) { return body->tears(); });
  }
};

void expect_same_state(const Scene& a, const Scene& b) {
  EXPECT_EQ(a.hash(), b.hash());
  EXPECT_EQ(a.tears(), b.tears());
  EXPECT_EQ(a.kinetic_energy(), b.kinetic_energy());
  EXPECT_EQ(a.elastic_energy(), b.elastic_energy());
}

// The number of steps of a run.
void play(Played& run) {
  constexpr long few = 8, after_tears = 5, more = 120; // steps
  constexpr long affordable = 60'000;                  // steps times vertices
  if (std::getenv("REND_WHOLE")) return run.go_to(run.steps());
  std::size_t vertices = 0;
  for (const auto& body : run.scene.bodies()) vertices += body->vertices();
  const long most =
      run.has_laws() ? std::min(more, affordable / static_cast<long>(std::max<std::size_t>(vertices, 1))) : 0;
  run.go_to(std::min(few, run.steps()));
  while (run.scene.tears() == 0 && run.scene.steps_done() < std::min(most, run.steps())) run.scene.step();
  if (run.scene.tears() > 0) run.go_to(std::min(run.scene.steps_done() + after_tears, run.steps()));
}

void build_anew(Body& body) {
  body.program = std::make_unique<Program>(*body.map, body.interactions, *body.mass, body.drag,
                                           ProgramOptions(body.program->options()));
  if (body.assembly) body.assembly = std::make_unique<Assembly>(*body.map, *body.program);
  for (TearLaw& law : body.tear_laws) {
    const LawSettings settings = law.settings();
    law = TearLaw(body.request_for(settings), settings);
  }
  body.evaluate();
}

class SameBytes : public testing::TestWithParam<std::string> {};

TEST_P(SameBytes, on_any_number_of_threads_and_with_everything_built_anew_at_each_change) {
  Played one(GetParam(), 1);
  play(one);
  for (const int threads : {2, 4}) {
    Played other(GetParam(), threads);
    other.go_to(one.scene.steps_done());
    SCOPED_TRACE(threads);
    expect_same_state(one.scene, other.scene);
  }
  if (one.scene.tears() == 0) return;
  Played anew(GetParam(), 1);
  for (const auto& body : anew.scene.bodies())
    body->change_observer = [&body = *body](WitnessAt when) {
      if (when == WitnessAt::AfterChanges) build_anew(body);
    };
  anew.go_to(one.scene.steps_done());
  SCOPED_TRACE("built anew");
  expect_same_state(one.scene, anew.scene);
}

INSTANTIATE_TEST_SUITE_P(All, SameBytes, testing::ValuesIn(shipped::all_presets()), shipped::as_word);

} // namespace
} // namespace rend::same_bytes_test
