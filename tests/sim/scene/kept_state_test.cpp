// States that are shown: those of the run alone, whether steps are redone or the map changes, and looked at or
// not, the steps are the same.
#include "sim/build/build_scene.h"

#include "sim/presets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace rend::kept_state_test {
namespace {

// Turns freely, in steps above the stable 4.5 ms: what round-off excites grows, until the guard redoes it.
const char* const turning = R"(<scene><body><bar cells="6 2 2" size="0.6 0.2 0.2"/><mass density="500"/>
  <elasticity model="corotational" young="1e5" poisson="0.3"/><place spin="0 0 20"/></body>
  <world gravity="0 0 0"/><time step="8e-3" integrator="symplectic" duration="3"/></scene>)";

// A sheet that is pulled apart while a ball falls on it.
const char* const tearing = R"(<scene><body><sheet pattern="triangles" cells="8 4" size="0.8 0.4"/>
  <mass total="0.1"/><springs><stretch k="60"/></springs><viscosity value="0.05" per="body"/><fix side="-x"/>
  <drive side="+x" velocity="0.4 0 0"/><tear criterion="strain" kind="stretch" threshold="0.25"/>
  <contact with="obstacles"/></body>
  <world><sphere centre="0.4 0.2 0.1" radius="0.05" mass="0.05"/></world>
  <time step="auto" duration="1"/></scene>)";

struct Shown {
  long step = 0;
  double time = 0, mechanical = 0, balance = 0; // [s], [J]
  std::size_t tears = 0;
  std::uint64_t hash = 0;
};

Shown of(const Scene& scene) {
  const EnergyFigures e = scene.energy();
  return {.step = scene.steps_done(),
          .time = scene.time(),
          .mechanical = e.now.kinetic + e.now.elastic,
          .balance = e.now.balance(),
          .tears = scene.tears(),
          .hash = scene.hash()};
}

void expect_equal(const Shown& a, const Shown& b) {
  EXPECT_EQ(a.step, b.step);
  EXPECT_EQ(a.time, b.time) << "step " << b.step;
  EXPECT_EQ(a.mechanical, b.mechanical) << "step " << b.step;
  EXPECT_EQ(a.balance, b.balance) << "step " << b.step;
  EXPECT_EQ(a.tears, b.tears) << "step " << b.step;
  EXPECT_EQ(a.hash, b.hash) << "step " << b.step;
}

// A run of which each state is asked for.
struct Watched {
  std::vector<Shown> all;
  std::uint64_t end = 0; // hash
};

Watched watch(const char* text, long steps) {
  const presets::Loaded scene = presets::load(text);
  Watched run;
  for (long n = 0; n <= steps; ++n) {
    scene->show_when_settled([&] { run.all.push_back(of(*scene.scene)); });
    if (n < steps) scene->step();
  }
  scene->settle();
  run.end = scene->hash();
  return run;
}

TEST(KeptState, each_is_shown_once_and_in_order) {
  for (const char* text : {turning, tearing}) {
    const Watched run = watch(text, 300);
    ASSERT_EQ(run.all.size(), 301U);
    for (long n = 0; n <= 300; ++n) EXPECT_EQ(run.all[static_cast<std::size_t>(n)].step, n);
  }
}

TEST(KeptState, no_discarded_attempt_is_shown) {
  const presets::Loaded bare = presets::load(turning);
  double most = 0; // of attempts that steps ended with
  for (long n = 0; n < 375; ++n) {
    bare->step();
    most = std::max(most, of(*bare.scene).mechanical);
  }
  const Watched run = watch(turning, 375);
  const double start = run.all.front().mechanical;
  ASSERT_GT(bare->guard().rejected, 0);
  ASSERT_GT(most, 2 * start); // what a frame would have shown
  for (const Shown& one : run.all) EXPECT_LT(one.mechanical, 1.001 * start) << "step " << one.step;
}

// Where a state is certain at once, it is that of a run that nobody looks at.
TEST(KeptState, looking_alters_no_step) {
  for (const char* text : {turning, tearing}) {
    const Watched run = watch(text, 600);
    const presets::Loaded alone = presets::load(text);
    int compared = 0;
    for (long n = 0; n <= 600; ++n) {
      if (alone->is_settled()) {
        expect_equal(of(*alone.scene), run.all[static_cast<std::size_t>(n)]);
        ++compared;
      }
      if (n < 600) alone->step();
    }
    alone->settle();
    EXPECT_EQ(alone->hash(), run.end);
    EXPECT_GT(compared, 2);
  }
}

// Nothing is redone here, so each state is that of a run which nobody looks at, on the map that it had.
TEST(KeptState, is_shown_on_the_map_that_it_had) {
  const Watched run = watch(tearing, 600);
  const presets::Loaded alone = presets::load(tearing);
  std::size_t with_tears = 0;
  for (long n = 0; n <= 600; ++n) {
    expect_equal(of(*alone.scene), run.all[static_cast<std::size_t>(n)]);
    with_tears += alone->tears() > 0;
    if (n < 600) alone->step();
  }
  ASSERT_EQ(alone->guard().rejected, 0);
  EXPECT_GT(with_tears, 50U);
  EXPECT_LT(with_tears, 550U);
}

TEST(KeptState, is_forgotten_by_a_return_to_what_is_certain) {
  const presets::Loaded scene = presets::load(turning);
  while (scene->is_settled() || scene->steps_done() < 10) scene->step();
  long shown = 0;
  scene->show_when_settled([&] { ++shown; });
  EXPECT_TRUE(scene->keeps_states());
  const long before = scene->steps_done();
  scene->return_to_settled();
  EXPECT_FALSE(scene->keeps_states());
  EXPECT_LT(scene->steps_done(), before);
  const presets::Loaded alone = presets::load(turning);
  while (scene->steps_done() < 100) scene->step();
  while (alone->steps_done() < 100) alone->step();
  EXPECT_EQ(scene->hash(), alone->hash());
  EXPECT_EQ(shown, 0);
}

} // namespace
} // namespace rend::kept_state_test
