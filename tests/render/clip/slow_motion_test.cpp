// Slow motion and motion blur of whole runs: the simulation is the same, pictures are where and as wide as
// they should be, and stopped, shared or partial runs have the bytes of a whole one.
#include "tests/render/clip/stopped_clip.h"
#include "tests/render/needs.h"

#include <gmock/gmock.h>

namespace rend::slow_motion_test {
namespace {

using program::Files;
using program::Outcome;
using program::TestFolder;
using testing::HasSubstr;

// A square of 0.5 m that moves to the right at 20 m/s, in front of the camera at 0.05 s.
constexpr const char* moving = R"(<scene name="moving">
  <body name="square">
    <sheet cells="2 2" size="0.5 0.5"/><place rotate="90 0 0" translate="-1.25 0 -0.25"/><mass total="0.1"/>
    <springs><stretch k="60"/><shear kind="isotropic" k="43"/></springs>
    <drive all="yes" velocity="20 0 0"/>
    <look edges="no"/>
  </body>
  <time step="1e-4" duration="0.1"/>
  <camera eye="0 -4 0" target="0 0 0" fov="30"/>
  <image size="320 160" fps="50" speed="0.5" background="none"/>
</scene>
)";

struct Row {      // the alphas of the middle row of a picture
  double sum = 0; // of all [pixels]
  int partly = 0; // columns that the square covers for a share of the time
};

class SlowMotion : public program::StoppedClip {
protected:
  SlowMotion() { place.write("moving.xml", moving); }

  Row row_of(const std::string& more) const {
    const Outcome made = place.rend("render moving.xml -q --frames 5 -o " + more);
    EXPECT_EQ(made.code, 0) << made.err;
    const Image image = read_png(place.path() / more.substr(0, more.find(' ')) / "00005.png");
    Row row;
    for (int x = 0; x < image.width; ++x) {
      const double alpha = image.at(x, image.height / 2)[3] / 255.0;
      row.sum += alpha;
      row.partly += alpha > 1.0 / 16 && alpha < 15.0 / 16 ? 1 : 0;
    }
    return row;
  }
};

// The frame shows 0.5 x 5/50 s = 0.05 s; the shutter is open for half of 1/50 s of the clip, in which the
// square moves by 20 x 0.5 x 0.01 = 0.1 m: a fifth of its width, on either side, less a stair of eight.
TEST_F(SlowMotion, a_body_that_moves_evenly_is_blurred_by_its_way) {
  NEEDS_PNG;
  const Row sharp = row_of("sharp");
  EXPECT_LE(sharp.partly, 2);
  const double way = sharp.sum / 5;
  const Row blurred = row_of("blurred --set image.shutter=0.5");
  EXPECT_NEAR(blurred.sum, sharp.sum, 0.7);
  EXPECT_NEAR(blurred.partly, 2 * way * 7 / 8, 3);
  const Row full = row_of("full --set image.shutter=1");
  EXPECT_NEAR(full.partly, 4 * way * 7 / 8, 3);
  const Row fast = row_of("fast --set image.shutter=0.5 --set image.fps=100 --set image.speed=1");
  EXPECT_NEAR(fast.partly, 2 * way * 7 / 8, 3) << "0.05 s too, and as far";
}

// A step is as long as the shutter is open: positions lie between two states.
TEST_F(SlowMotion, long_steps_blur_evenly) {
  NEEDS_PNG;
  const Row fine = row_of("fine --set image.shutter=1");
  const Row coarse = row_of("coarse --set image.shutter=1 --set time.step=0.01 --set time.integrator=implicit");
  EXPECT_NEAR(coarse.sum, fine.sum, 0.7);
  EXPECT_NEAR(coarse.partly, fine.partly, 2);
}

TEST_F(SlowMotion, changes_no_step) {
  NEEDS_PNG;
  const auto hash = [&](const std::string& more) {
    const Outcome made = place.rend("render clip.xml -q --json --size 32x32 -o " + more);
    EXPECT_EQ(made.code, 0) << made.err;
    return std::pair(made.json().at("hash").get<std::string>(), made.json().at("steps").get<long>());
  };
  const auto real = hash("real");
  EXPECT_EQ(hash("slow --set image.speed=0.3 --set image.shutter=0.7"), real);
  EXPECT_EQ(place.rend("run clip.xml -q --json --set image.speed=0.3").json().at("hash"), real.first);
}

constexpr const char* keyed = R"(<image size="64 48" fps="100" samples="1" shutter="0.6" shutter-samples="5">
    <key at="0.05" speed="2"/><key at="0.1" speed="0.5"/><key at="0.2" speed="1"/></image>)";

class BlurredClip : public program::StoppedClip {
protected:
  BlurredClip() {
    std::string text = program::followed;
    const std::string plain = R"(<image size="64 48" fps="100" samples="1"/>)";
    text.replace(text.find(plain), plain.size(), keyed);
    place.write("clip.xml", text);
  }
};

// 0.05 s at 2, 0.05 s at a mean of 1.25, 0.1 s at 0.75, 0.1 s at 1: 0.2983 s of the clip.
TEST_F(BlurredClip, has_the_frames_that_are_told) {
  NEEDS_PNG;
  EXPECT_EQ(alone().size(), 30u);
  const nlohmann::json told = place.rend("info clip.xml --json").json();
  EXPECT_THAT(told.dump(), HasSubstr(R"("frames":30)"));
  EXPECT_THAT(told.dump(), HasSubstr(R"("clip_duration":0.298)"));
}

TEST_F(BlurredClip, in_parts_has_the_bytes_of_the_whole) {
  NEEDS_PNG;
  const Files all = alone();
  for (const char* part : {"1/3", "3/3", "2/3"})
    EXPECT_EQ(place.rend(fmt::format("render clip.xml -q -o parts --shard {}", part)).code, 0);
  expect_same(in("parts"), all, "");
  EXPECT_EQ(place.rend("render clip.xml -q -o some --frames 7,21-23").code, 0);
  EXPECT_EQ(in("some").size(), 4u);
  expect_part_of(in("some"), all, "");
}

TEST_F(BlurredClip, stopped_at_any_moment_goes_on_with_the_same_bytes) {
  NEEDS_PNG;
  const Files all = alone();
  for (int trial = 0; trial < 4; ++trial) {
    const std::string folder = fmt::format("stopped-{}", trial);
    const std::string line = "render clip.xml -q --resume --checkpoint-every 0.02 -o " + folder;
    stopped(trial % 2 == 0 ? "TERM" : "KILL", moment(), line);
    expect_part_of(in(folder), all, folder);
    EXPECT_EQ(place.rend(line).code, 0);
    expect_same(in(folder), all, folder);
  }
  stop_midway("surely");
  EXPECT_EQ(place.rend("render clip.xml -q --resume -o surely").code, 0);
  expect_same(in("surely"), all, "");
}

// Steps longer than frames: moments lie between states, of which some have passed when a frame comes.
TEST_F(BlurredClip, of_long_steps_goes_on_with_the_same_bytes) {
  NEEDS_PNG;
  const std::string more = " --set time.step=0.013 --set time.integrator=implicit --set image.shutter=1";
  const Files all = alone(more);
  stop_midway("surely", "render clip.xml -q" + more);
  EXPECT_EQ(place.rend("render clip.xml -q --resume -o surely" + more).code, 0);
  expect_same(in("surely"), all, "");
}

} // namespace
} // namespace rend::slow_motion_test
