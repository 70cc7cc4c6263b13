// A scene that is stopped within a step can be stored, and goes on to the bit as if it had never been stopped.
#include "render/picture/scene_preset.h"
#include "sim/base/archive.h"
#include "sim/base/stop_request.h"
#include "sim/base/wall_clock.h"
#include "sim/build/build_scene.h"
#include "sim/scene/scene.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <random>
#include <thread>

namespace rend::stop_test {
namespace {

struct Clip {
  std::string name, time; // attributes of <time>
  long steps;
};
void PrintTo(const Clip& clip, std::ostream* out) {
  *out << clip.name;
}

// Two bodies, of which one tears: work by drives and loads, laws, and states that schemes hand on.
std::string preset_of(const Clip& clip) {
  return fmt::format(R"(<scene name="stopped">
  <body name="torn">
    <bar cells="6 3 3" size="1 0.5 0.5"/><mass total="1"/>
    <elasticity young="2e4" poisson="0.3" model="corotational" damping-mass="2"/>
    <fix side="-x"/><drive side="+x" velocity="1 0 0"/>
    <tear criterion="atomic-border" threshold="300"/>
  </body>
  <body name="other">
    <bar cells="5 3 3" size="1 0.5 0.5"/><place translate="0 2 0"/><mass total="1"/>
    <elasticity young="2e4" poisson="0.3"/>
    <fix side="-x"/><load side="+x" force="0 0 3"/>
  </body>
  <world gravity="0 0 -9.81"/>
  <time {}/>
</scene>)",
                     clip.time);
}

struct ClipRun {
  std::unique_ptr<PresetNode> preset;
  std::unique_ptr<Scene> scene;
  explicit ClipRun(const std::string& text)
      : preset(load_scene_text(text, "stopped.xml", {})),
        scene(std::make_unique<Scene>(read_scene(*preset), SceneOptions{})) {}
  void go_to(long step) const {
    while (scene->steps_done() < step) scene->step();
  }
};

class StoppedScene : public testing::TestWithParam<Clip> {
protected:
  void TearDown() override { withdraw_stop(); }
};

TEST_P(StoppedScene, goes_on_to_the_bit) {
  const Clip clip = GetParam();
  const std::string text = preset_of(clip);
  const ClipRun whole(text);
  const double start = wall_clock();
  whole.go_to(clip.steps);
  const double seconds = wall_clock() - start;
  std::mt19937 random(5);
  int stopped = 0, lost = 0;
  for (int trial = 0; trial < 60 && stopped < 8; ++trial) { // on a busy machine some stops come too late
    const ClipRun first(text), second(text);
    const double after = seconds * std::uniform_real_distribution<>(0, 0.9)(random);
    std::thread other([&] {
      std::this_thread::sleep_for(std::chrono::duration<double>(after));
      request_stop(0);
    });
    bool here = false;
    try {
      first.go_to(clip.steps);
    } catch (const StopRequested&) {
      here = true;
    }
    other.join();
    withdraw_stop();
    stopped += here;
    if (!here) continue;
    lost += !first.scene->can_be_stored();
    EXPECT_GE(first.scene->tears(), 0u); // what it has can be looked at
    EXPECT_TRUE(std::isfinite(first.scene->energy().now.balance()));
    if (!first.scene->can_be_stored()) continue;
    Archive out;
    first.scene->store(out);
    Archive in{std::span<const std::uint8_t>(out.bytes())};
    second.scene->store(in);
    in.end();
    second.go_to(clip.steps);
    EXPECT_EQ(second.scene->hash(), whole.scene->hash()) << "stopped at step " << first.scene->steps_done();
    EXPECT_EQ(second.scene->tears(), whole.scene->tears());
    EXPECT_EQ(second.scene->energy().now.balance(), whole.scene->energy().now.balance());
    EXPECT_EQ(second.scene->energy().now.work.sum(), whole.scene->energy().now.work.sum());
  }
  EXPECT_GE(stopped, 6);
  EXPECT_LE(lost, 2) << "a stop within laws";
}

INSTANTIATE_TEST_SUITE_P(
    All, StoppedScene,
    testing::Values(Clip{"implicit", R"(step="0.02" duration="1" integrator="implicit")", 40},
                    Clip{"tr_bdf2", R"(step="0.02" duration="1" integrator="tr-bdf2")", 40},
                    Clip{"alpha", R"(step="0.02" duration="1" integrator="alpha")", 40},
                    Clip{"rk45", R"(step="0.02" duration="1" integrator="rk45" tolerance="1e-9")", 30},
                    Clip{"symplectic", R"(step="5e-4" duration="1" integrator="symplectic")", 1500},
                    Clip{"redone", R"(step="9e-3" duration="1" integrator="symplectic")", 80},
                    Clip{"rk4_redone", R"(step="2e-2" duration="1" integrator="rk4")", 40}),
    [](const auto& one) { return one.param.name; });

// The state of a static clip is found in one step.
TEST(StoppedStatic, goes_on_to_the_bit) {
  const Clip clip{"static", R"(duration="1" integrator="static")", 1};
  const std::string text = preset_of(clip);
  const ClipRun whole(text);
  whole.go_to(1);
  const ClipRun first(text), second(text);
  request_stop(1e-3);
  EXPECT_THROW(first.go_to(1), StopRequested);
  withdraw_stop();
  ASSERT_TRUE(first.scene->can_be_stored());
  Archive out;
  first.scene->store(out);
  Archive in{std::span<const std::uint8_t>(out.bytes())};
  second.scene->store(in);
  in.end();
  second.go_to(1);
  EXPECT_EQ(second.scene->hash(), whole.scene->hash());
}

} // namespace
} // namespace rend::stop_test
