// Runs that are killed or stopped and then resumed give the same bytes as an uninterrupted run.
//
// By default at a few moments each; with REND_WHOLE in the environment at fifty (tests/run --all).
#include "render/files/video_format.h"
#include "tests/render/clip/stopped_clip.h"
#include "tests/render/needs.h"
#include "tests/test_paths.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <chrono>
#include <set>

namespace rend::resume_test {
namespace {

using program::Files;
using program::Outcome;
using testing::HasSubstr;
namespace fs = std::filesystem;

bool whole() {
  return std::getenv("REND_WHOLE") != nullptr;
}

class Resume : public program::StoppedClip {};

TEST_F(Resume, after_a_kill_at_any_moment_no_picture_is_partial_and_all_bytes_come_out_equal) {
  NEEDS_PNG;
  const Files all = alone();
  ASSERT_EQ(all.size(), 31u);
  for (int trial = 0; trial < (whole() ? 50 : 3); ++trial) {
    const std::string folder = fmt::format("killed-{}", trial), note = fmt::format(" trial {}", trial);
    const std::string line = "render clip.xml -q --resume --checkpoint-every 0.03 -o " + folder;
    const double first = moment();
    stopped("KILL", first, line);
    expect_part_of(in(folder), all, fmt::format("{}, killed after {:.3f} s", note, first));
    stopped("KILL", moment(), line); // killed again after resuming
    expect_part_of(in(folder), all, note + ", killed twice");
    const Outcome last = place.rend(line);
    EXPECT_EQ(last.code, 0) << last.err;
    expect_same(in(folder), all, note);
  }
}

TEST_F(Resume, a_signal_leaves_a_checkpoint_and_going_on_equals_never_having_stopped) {
  NEEDS_PNG;
  const Files all = alone();
  for (int trial = 0; trial < (whole() ? 50 : 3); ++trial) {
    const std::string folder = fmt::format("stopped-{}", trial), note = fmt::format(" trial {}", trial);
    const std::string line = "render clip.xml --resume --checkpoint-every 0 -o " + folder;
    const bool by_term = trial % 2 == 0;
    const Outcome first = stopped(by_term ? "TERM" : "INT", moment(), line);
    const Files there = in(folder);
    expect_part_of(there, all, note);
    if (there.contains("clip.checkpoint")) {
      EXPECT_EQ(first.code, by_term ? 143 : 130) << first.err;
      EXPECT_THAT(first.err, HasSubstr("--resume"));
      const Outcome last = place.rend(line);
      EXPECT_THAT(last.err, HasSubstr("continuing at")) << "not from the start";
      EXPECT_EQ(last.code, 0) << last.err;
    } else {
      EXPECT_EQ(place.rend(line).code, 0); // it was building the scene, or done
    }
    expect_same(in(folder), all, note);
  }
  stop_midway("surely");
  expect_part_of(in("surely"), all, "");
  const Outcome last = place.rend("render clip.xml --resume -o surely");
  EXPECT_THAT(last.err, HasSubstr("continuing at"));
  EXPECT_EQ(last.code, 0);
  expect_same(in("surely"), all, "");
}

TEST_F(Resume, a_signal_after_the_first_picture_leaves_a_checkpoint) {
  NEEDS_PNG;
  const std::string line = "render clip.xml --resume --set time.step=5e-5 -o ";
  EXPECT_EQ(place.rend(line + "alone").code, 0);
  const Outcome first = stopped_when("[ -e c/00000.png ]", line + "c");
  EXPECT_EQ(first.code, 143) << first.err;
  EXPECT_TRUE(in("c").contains("clip.checkpoint"));
  expect_part_of(in("c"), in("alone"), "");
  EXPECT_THAT(place.rend(line + "c").err, HasSubstr("continuing at"));
  expect_same(in("c"), in("alone"), "");
}

// Its only picture shows the initial state.
TEST_F(Resume, a_run_that_is_stopped_before_it_goes_wrong_keeps_no_more_than_one_that_is_not) {
  NEEDS_PNG;
  const std::string line = "render clip.xml -q --no-guard --set 'body[cloth].sheet.cells=100 100' "
                           "--set time.integrator=explicit --set time.step=1e-3 --fps 0.01";
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(place.rend(line + " -o alone").code, 76);
  seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_TRUE(in("alone").empty());
  stop_midway("c", line);
  ASSERT_TRUE(in("c").contains("00000.png"));
  const Outcome last = place.rend(line + " --resume -o c");
  EXPECT_EQ(last.code, 76) << last.err;
  EXPECT_TRUE(in("c").empty());
}

TEST_F(Resume, where_all_pictures_are_there_nothing_is_said_of_a_simulation) {
  NEEDS_PNG;
  const std::string line = "render clip.xml -q --resume -o c --json";
  const auto made = place.rend(line).json();
  const Outcome outcome = place.rend(line);
  EXPECT_EQ(outcome.code, 0);
  const auto figures = outcome.json();
  EXPECT_EQ(figures["kept"], 31);
  ASSERT_EQ(figures.size(), made.size());
  const std::set<std::string> of_the_run{"preset",  "name",  "integrator", "step", "stopped",
                                         "seconds", "bytes", "frames",     "kept"};
  for (const auto& [name, figure] : made.items()) {
    EXPECT_TRUE(figures.contains(name)) << name;
    if (!of_the_run.contains(name)) {
      EXPECT_FALSE(figure.is_null()) << name;
      EXPECT_TRUE(figures[name].is_null()) << name;
    }
  }
}

TEST_F(Resume, a_video_is_that_of_a_run_that_was_never_stopped) {
  NEEDS_PNG;
  NEEDS_VIDEO;
  const Files all = alone("--video mkv");
  stop_midway("stopped");
  EXPECT_EQ(place.rend("render clip.xml -q --resume -o stopped --video mkv").code, 0);
  expect_same(in("stopped"), all, "");
}

TEST_F(Resume, a_video_that_is_cut_short_by_a_signal_is_called_a_part) {
  NEEDS_PNG;
  NEEDS_VIDEO;
  for (const std::string& format : video_format_names()) {
    const std::string folder = format, line = "render clip.xml --set time.step=2e-5 --video " + format + " -o ";
    // the video may be a few pictures behind the files
    const Outcome first = stopped_when("[ -e " + folder + "/00006.png ]", line + folder);
    ASSERT_EQ(first.code, 143) << format << first.err;
    EXPECT_FALSE(in(folder).contains("clip." + format));
    ASSERT_TRUE(in(folder).contains("clip.part." + format)) << format;
    EXPECT_THAT(first.out, HasSubstr(folder + "/clip.part." + format + ", a video that ends early"));
    const std::string probe = "ffprobe -v error -count_frames -show_entries stream=nb_read_frames -of csv=p=0 ";
    const Outcome frames = place.shell(probe + folder + "/clip.part." + format);
    EXPECT_EQ(frames.err, "") << format;
    EXPECT_GE(std::atoi(frames.out.c_str()), 4) << format;
  }
  const std::string line = "render clip.xml -q --video mkv --no-png -o bare";
  EXPECT_EQ(stopped_when("[ -s bare/clip.part.mkv ]", line + " --set time.step=2e-5").code, 143);
  EXPECT_EQ(in("bare").size(), 1u);
  EXPECT_EQ(place.rend(line).code, 0);
  EXPECT_EQ(in("bare").size(), 1u) << "the part is replaced by the whole";
  EXPECT_TRUE(in("bare").contains("clip.mkv"));
}

TEST_F(Resume, makes_again_what_is_missing_or_wrong_and_touches_nothing_else) {
  NEEDS_PNG;
  const Files all = alone();
  const fs::path folder = place.path() / "alone";
  const auto date = fs::last_write_time(folder / "00000.png");
  fs::remove(folder / "00003.png");
  fs::copy_file(folder / "00001.png", folder / "00005.png", fs::copy_options::overwrite_existing);
  std::string flipped = all.at("00007.png"), cut = all.at("00009.png");
  flipped[flipped.size() / 2] ^= 1;
  cut.resize(cut.size() - 20);
  place.write("alone/00007.png", flipped);
  place.write("alone/00009.png", cut);
  place.write("alone/00011.png", "");
  const Outcome outcome = place.rend("render clip.xml --resume -o alone --json");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.json()["frames"], 5);
  EXPECT_EQ(outcome.json()["kept"], 26);
  expect_same(in("alone"), all, "");
  EXPECT_EQ(fs::last_write_time(folder / "00000.png"), date);
}

TEST_F(Resume, pictures_of_another_scene_are_made_again) {
  NEEDS_PNG;
  const Files all = alone();
  EXPECT_EQ(place.rend("render clip.xml -q --set body[cloth].mass.total=0.2 -o other").code, 0);
  EXPECT_EQ(place.rend("render clip.xml -q --resume -o other").code, 0);
  expect_same(in("other"), all, "");
}

TEST_F(Resume, a_full_disk_leaves_whole_pictures_alone_and_going_on_makes_the_rest) {
  NEEDS_PNG;
  const Files all = alone();
  std::size_t least = std::string::npos, most = 0;
  for (const auto& [name, bytes] : all) {
    least = std::min(least, bytes.size());
    most = std::max(most, bytes.size());
  }
  // units of the shell's ulimit -f: less than the largest picture
  const std::size_t blocks = most / 512 - (most % 512 == 0 ? 1 : 0);
  const Outcome outcome = place.shell(
      fmt::format("(ulimit -f {}; exec {} render clip.xml -q -o full)", blocks, test::rend_program));
  EXPECT_EQ(outcome.code, 74) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("writing failed"));
  const Files there = in("full");
  expect_part_of(there, all, "");
  EXPECT_LT(there.size(), all.size());
  for (const auto& [name, bytes] : there) EXPECT_TRUE(name.ends_with(".png")) << name;
  EXPECT_EQ(place.rend("render clip.xml -q --resume -o full").code, 0);
  expect_same(in("full"), all, "");
}

TEST_F(Resume, while_a_scene_is_built_a_signal_ends_at_once_and_leaves_nothing) {
  NEEDS_PNG;
  const std::string handled = "[ $((0x$(sed -n 's/^SigCgt:[^0-9a-f]*//p' /proc/$pid/status) & 0x4000)) -ne 0 ]";
  const Outcome outcome = stopped_when(
      handled, "render clip.xml -o x --set 'body[cloth].sheet.cells=1500 1500' --set time.step=1e-6");
  EXPECT_EQ(outcome.code, 143);
  EXPECT_TRUE(in("x").empty());
}

} // namespace
} // namespace rend::resume_test
