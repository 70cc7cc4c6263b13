// A steady step allocates no memory: 100 steps after as many to warm up, of every shipped preset and every
// scheme.
//
// Steady: no law attempts a change, the guard rejects no step, and contact does not search for new pairs.
#include "render/picture/scene_preset.h"
#include "sim/allocations.h"
#include "sim/build/build_scene.h"
#include "sim/guard/guard.h"
#include "sim/presets.h"
#include "sim/shipped_presets.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace rend::steady_test {
namespace {

constexpr long steps = 100;
constexpr int windows = 8; // of that many steps

// Events after which a step is not steady.
struct Events {
  // changes (made or not), rejected steps of the guard, searches for contact pairs
  long tried, rejected, searches;
  bool operator==(const Events&) const = default;
  static Events of(const Scene& scene, long tried) {
    return {tried, scene.guard().rejected, scene.contacts() ? scene.contacts()->searches() : 0};
  }
};

const std::string none_steady = "no step was steady";

// The call stacks and numbers of allocations in steady steps among the next ones; empty: none.
std::string askers(Scene& scene) {
  long asked = 0, steady = 0, tried = 0;
  for (const auto& body : scene.bodies()) body->change_observer = [&tried](WitnessAt) { ++tried; };
  std::string who;
  for (long n = 0; n < steps; ++n) {
    const Events before = Events::of(scene, tried);
    const long here = allocations::in([&] { scene.step(); });
    if (!(Events::of(scene, tried) == before)) continue;
    ++steady;
    if (here == 0) continue;
    if (asked == 0) who = fmt::format("in step {}, {}", scene.steps_done(), allocations::who());
    asked += here;
  }
  for (const auto& body : scene.bodies()) body->change_observer = nullptr;
  if (steady == 0) return none_steady;
  return asked == 0 ? "" : fmt::format("{} times, {}", asked, who);
}

// At first contacts scratch arrays grow: so only one of a few windows must be free of allocations.
void expect_none(Scene& scene) {
  if (!allocations::counted) GTEST_SKIP() << "AddressSanitizer has its own allocator";
  for (long n = 0; n < steps; ++n) scene.step();
  std::string found = "not looked yet";
  for (int window = 0; window < windows && !found.empty(); ++window) found = askers(scene);
  if (found == none_steady) GTEST_SKIP() << "something tears in every step";
  EXPECT_EQ(found, "");
}

class SteadyPreset : public testing::TestWithParam<std::string> {};

TEST_P(SteadyPreset, asks_for_no_memory) {
  const auto preset = load_scene(shipped::path_of(GetParam()));
  Scene scene(read_scene(*preset, scene_pictures()), SceneOptions{.threads = 2});
  expect_none(scene);
}

INSTANTIATE_TEST_SUITE_P(All, SteadyPreset, testing::ValuesIn(shipped::all_presets()), shipped::as_word);

std::vector<std::string> schemes() {
  std::vector<std::string> names;
  for (const Scheme& scheme : all_schemes()) names.push_back(scheme.name);
  return names;
}

class SteadyScheme : public testing::TestWithParam<std::string> {};

// Springs of every kind, a law that measures all of them, a driven corner, wind, and a floor below, where the
// scheme supports it.
TEST_P(SteadyScheme, asks_for_no_memory) {
  const Scheme& scheme = *find_scheme(GetParam());
  const std::string contact = scheme.solves && !scheme.solves_contact ? "" : R"(<contact with="floor"/>)";
  const std::string time = R"(<time step="1e-4" integrator=")" + GetParam() + R"(" duration="1"/>)";
  const std::string world = R"(<world gravity="0 0 -9.81"><floor z="-1"/><wind velocity="0 1 0"/></world>)";
  const presets::Loaded scene =
      presets::load(presets::cloth("quads", 8, R"(<tear criterion="global-border" threshold="1e9"/>)" + contact,
                                   world + time),
                    {.threads = 2});
  expect_none(*scene.scene);
}

INSTANTIATE_TEST_SUITE_P(All, SteadyScheme, testing::ValuesIn(schemes()));

} // namespace
} // namespace rend::steady_test
