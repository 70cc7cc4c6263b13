// Runs that are killed, stopped, or share their frames leave the bytes of one that was left alone.
//
// By default at a few moments each; with REND_WHOLE in the environment at fifty (tests/run --all).
#include "render/app/checkpoint.h"
#include "render/app/film.h"
#include "render/app/session.h"
#include "render/png.h"
#include "sim/base/error.h"
#include "tests/render/app/program_run.h"
#include "tests/render/needs.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <chrono>
#include <map>
#include <set>

namespace rend {
namespace {

using program::content;
using program::Outcome;
using program::Place;
using testing::HasSubstr;
namespace fs = std::filesystem;

// All that pictures follow over a clip: a scale, colours of fragments, curves, a camera that goes after the body.
constexpr const char* followed = R"(<scene name="clip">
  <body name="cloth">
    <sheet cells="8 8" size="1 1"/><place rotate="90 0 0"/><mass total="0.1"/>
    <springs><stretch k="60"/><shear kind="isotropic" k="43"/><bend kind="provot" k="10"/></springs>
    <viscosity value="0.1" per="body"/>
    <fix side="-x"/><drive side="+x" velocity="4 0 0"/>
    <tear criterion="global-border" threshold="2" max-per-step="1"/>
    <look by="fragment"/>
  </body>
  <body name="other">
    <sheet cells="3 3" size="0.5 0.5"/><place translate="0 0 -1"/><mass total="0.1"/>
    <springs><stretch k="60"/></springs>
    <look by="force"/>
  </body>
  <time step="2e-4" integrator="rk4" duration="0.3"/>
  <camera frame="follow"/>
  <image size="64 48" fps="100" samples="1"/>
  <hud show="time energy tears legend"/>
</scene>
)";

using Files = std::map<std::string, std::string>; // name → bytes

bool whole() {
  return std::getenv("REND_WHOLE") != nullptr;
}

class Resume : public testing::Test {
protected:
  Resume() { place.write("clip.xml", followed); }

  Files in(const std::string& folder) const {
    Files all;
    std::error_code error;
    for (fs::directory_iterator at(place.path() / folder, error), end; !error && at != end; at.increment(error))
      all[at->path().filename().string()] = content(at->path());
    return all;
  }
  // Of a run that was left alone, and how long it takes [s].
  Files alone(const std::string& more = "") {
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(place.rend("render clip.xml -q -o alone " + more).code, 0);
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return in("alone");
  }
  Outcome stopped(const char* signal, double after, const std::string& arguments) const {
    return place.shell(
        fmt::format("timeout --preserve-status -s {} {:.3f} {} {}", signal, after, REND_PROGRAM, arguments));
  }
  double moment() { return 0.02 + seconds * std::uniform_real_distribution<>(0, 1)(random); }

  // Stops it as soon as `ready`, a condition of the shell in which $pid is the program's, holds.
  Outcome stopped_when(const std::string& ready, const std::string& arguments) const {
    return place.shell(fmt::format("{} {} & pid=$!; until {} || ! kill -0 $pid; do sleep 0.005; done; "
                                   "kill -TERM $pid; wait $pid",
                                   REND_PROGRAM, arguments, ready));
  }

  // Stops runs into a folder at moments between too early and too late, until one leaves its checkpoint there.
  void stop_on_the_way(const std::string& folder, const std::string& line = "render clip.xml -q") const {
    double early = 0, late = 1.2 * seconds;
    for (int n = 0; n < 20 && !in(folder).contains("clip.checkpoint"); ++n) {
      fs::remove_all(place.path() / folder);
      const double after = 0.5 * (early + late);
      const Outcome outcome = stopped("TERM", after, line + " -o " + folder);
      (outcome.code == 143 ? early : late) = after;
      early *= 0.9; // machines are not always as fast
      late *= 1.1;
    }
    ASSERT_TRUE(in(folder).contains("clip.checkpoint"));
  }

  static void expect_part_of(const Files& some, const Files& all, const std::string& note) {
    for (const auto& [name, bytes] : some) {
      if (!name.ends_with(".png")) continue;
      ASSERT_TRUE(all.contains(name)) << note;
      EXPECT_TRUE(bytes == all.at(name)) << name << " " << note;
    }
  }
  static void expect_same(const Files& some, const Files& all, const std::string& note) {
    expect_part_of(some, all, note);
    for (const auto& [name, bytes] : all)
      EXPECT_TRUE(some.contains(name) && some.at(name) == bytes) << name << note;
    for (const auto& [name, bytes] : some) EXPECT_TRUE(all.contains(name)) << name << " is left over" << note;
  }

  const Place place;
  double seconds = 0;
  std::mt19937 random{7};
};

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
    stopped("KILL", moment(), line); // and again, on its way from there
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
      EXPECT_THAT(last.err, HasSubstr("goes on at")) << "not from the start";
      EXPECT_EQ(last.code, 0) << last.err;
    } else {
      EXPECT_EQ(place.rend(line).code, 0); // it was building, or done
    }
    expect_same(in(folder), all, note);
  }
  stop_on_the_way("surely");
  expect_part_of(in("surely"), all, "");
  const Outcome last = place.rend("render clip.xml --resume -o surely");
  EXPECT_THAT(last.err, HasSubstr("goes on at"));
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
  EXPECT_THAT(place.rend(line + "c").err, HasSubstr("goes on at"));
  expect_same(in("c"), in("alone"), "");
}

// All that its only picture shows is the start.
TEST_F(Resume, a_run_that_is_stopped_before_it_goes_wrong_keeps_no_more_than_one_that_is_not) {
  NEEDS_PNG;
  const std::string line = "render clip.xml -q --no-guard --set 'body[cloth].sheet.cells=100 100' "
                           "--set time.integrator=explicit --set time.step=1e-3 --fps 0.01";
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(place.rend(line + " -o alone").code, 76);
  seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_TRUE(in("alone").empty());
  stop_on_the_way("c", line);
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

// Its pictures are the same bytes, but the state that it stored is no other program's.
TEST_F(Resume, another_build_of_the_same_commit_keeps_pictures_and_no_state) {
  NEEDS_PNG;
  const Files all = alone();
  EXPECT_EQ(place.shell(fmt::format("cp {} other && echo built anew >> other", REND_PROGRAM)).code, 0);
  const Outcome whole = place.shell("./other render clip.xml -q --resume -o alone --json");
  EXPECT_EQ(whole.code, 0) << whole.err;
  EXPECT_EQ(whole.json()["kept"], all.size());
  expect_same(in("alone"), all, "");

  stop_on_the_way("stopped");
  const Files before = in("stopped");
  const Outcome refused = place.shell("./other render clip.xml -q --resume -o stopped");
  EXPECT_EQ(refused.code, 65);
  EXPECT_THAT(refused.err, HasSubstr("another rend"));
  expect_same(in("stopped"), before, "");
}

TEST_F(Resume, a_video_is_that_of_a_run_that_was_never_stopped) {
  NEEDS_PNG;
  NEEDS_VIDEO;
  const Files all = alone("--video mkv");
  stop_on_the_way("stopped");
  EXPECT_EQ(place.rend("render clip.xml -q --resume -o stopped --video mkv").code, 0);
  expect_same(in("stopped"), all, "");
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

TEST_F(Resume, a_checkpoint_of_something_else_is_refused_and_nothing_is_lost) {
  NEEDS_PNG;
  alone();
  stop_on_the_way("c");
  const Files before = in("c");
  for (const char* other : {"--set body[cloth].mass.total=0.2", "--size 80x60", "--kernels walk", "--fps 50"}) {
    const Outcome outcome = place.rend(std::string("render clip.xml -q --resume -o c ") + other);
    EXPECT_EQ(outcome.code, 65) << other;
    EXPECT_THAT(outcome.err, testing::AllOf(HasSubstr("c/clip.checkpoint"), HasSubstr("of another preset"),
                                            HasSubstr("without --resume")));
    EXPECT_TRUE(in("c") == before) << other;
  }
  std::string damaged = before.at("clip.checkpoint");
  damaged[damaged.size() / 2] ^= 1;
  place.write("c/clip.checkpoint", damaged);
  EXPECT_THAT(place.rend("render clip.xml -q --resume -o c").err, HasSubstr("damaged"));
  place.write("c/clip.checkpoint", "hello");
  EXPECT_EQ(place.rend("render clip.xml -q --resume -o c").code, 65);
  EXPECT_EQ(place.rend("render clip.xml -q -o c").code, 0) << "begins anew";
  EXPECT_FALSE(in("c").contains("clip.checkpoint"));
}

// A run in this process, its pictures left out.
struct Made {
  Session session;
  Film film;
  std::string key;
  explicit Made(const Place& place)
      : session(quietly(place)), film(session, files_in(place), FramePlan{}),
        key(picture_key(session, 64, 48, 1)) {}
  static SessionOptions quietly(const Place& place) {
    SessionOptions options;
    options.preset = (place.path() / "clip.xml").string();
    options.quiet = true;
    return options;
  }
  static PipelineOptions files_in(const Place& place) {
    PipelineOptions files;
    files.folder = place.path() / "c";
    files.width = 64;
    files.height = 48;
    files.png = false;
    return files;
  }
};

TEST_F(Resume, a_checkpoint_s_next_frame_and_state_are_of_the_same_bytes) {
  const fs::path path = place.path() / "one.checkpoint";
  Made from(place), to(place);
  from.session.run(5, {[](long) {}, {}});
  write_checkpoint(path, from.key, 6, from.session, from.film);
  const std::uint64_t fresh = to.session.scene().hash();
  EXPECT_FALSE(read_checkpoint(path, to.key, 5, to.session, to.film)) << "rewritten since it was found";
  EXPECT_FALSE(read_checkpoint(path, "1", 30, to.session, to.film));
  EXPECT_FALSE(read_checkpoint(place.path() / "gone.checkpoint", to.key, 30, to.session, to.film));
  EXPECT_EQ(to.session.scene().hash(), fresh);
  const auto head = read_checkpoint(path, to.key, 30, to.session, to.film);
  ASSERT_TRUE(head);
  EXPECT_EQ(head->next, 6);
  EXPECT_EQ(to.session.scene().hash(), from.session.scene().hash());

  const std::string bytes = content(path);
  for (std::size_t n = bytes.find('\n') + 1, end = n + 16; n < end; ++n) { // key, next frame
    std::string other = bytes;
    other[n] = static_cast<char>(other[n] ^ 1);
    place.write("one.checkpoint", other);
    EXPECT_THROW(read_checkpoint(path, to.key, 30, to.session, to.film), UserError) << "byte " << n;
  }
  write_checkpoint(path, from.key, 7, from.session, from.film); // of a state before frame 6
  EXPECT_THROW(read_checkpoint(path, to.key, 30, to.session, to.film), UserError);
}

TEST_F(Resume, the_best_checkpoint_is_the_run_s_own_then_the_latest_of_the_others) {
  Made run(place);
  fs::create_directories(place.path() / "c");
  const auto write = [&](const char* name, long next) {
    write_checkpoint(place.path() / "c" / name, run.key, next, run.session, run.film);
  };
  const auto found = [&](long first) {
    std::vector<std::string> names;
    for (const auto& one : find_checkpoints(place.path() / "c/own.checkpoint", run.key, first))
      names.push_back(one.path.filename().string());
    return names;
  };
  EXPECT_TRUE(found(30).empty());
  write("a.checkpoint", 3);
  write("b.checkpoint", 9);
  write("c.checkpoint", 20);
  place.write("c/d.checkpoint", "hello");
  EXPECT_THAT(found(10), testing::ElementsAre("b.checkpoint", "a.checkpoint"));
  write("own.checkpoint", 5);
  EXPECT_THAT(found(10), testing::ElementsAre("own.checkpoint", "b.checkpoint", "a.checkpoint"));
  EXPECT_THAT(found(4), testing::ElementsAre("a.checkpoint"));
}

TEST_F(Resume, shards_make_the_bytes_of_one_run) {
  NEEDS_PNG;
  const Files all = alone();
  for (int count : {1, 2, 3, 7, 40}) {
    const std::string folder = fmt::format("shards-{}", count);
    for (int n = 1; n <= count; ++n) {
      if (count == 40 && n > 2 && n < 39) continue; // some of them have nothing to do
      EXPECT_EQ(place.rend(fmt::format("render clip.xml -q -o {} --shard {}/{}", folder, n, count)).code, 0);
    }
    count < 40 ? expect_same(in(folder), all, folder) : expect_part_of(in(folder), all, folder);
  }
}

TEST_F(Resume, fewer_frames_leave_the_checkpoint_of_a_later_one_alone) {
  NEEDS_PNG;
  const Files all = alone();
  stop_on_the_way("c");
  const Files before = in("c");
  const std::string line = "render clip.xml --resume -o c --frames 0";
  const Outcome there = place.rend(line + " --json");
  EXPECT_EQ(there.code, 0) << there.err;
  EXPECT_THAT(there.err, HasSubstr("clip.checkpoint is of frames beyond these"));
  EXPECT_EQ(there.json()["kept"], 1);
  EXPECT_TRUE(there.json()["steps"].is_null()) << "no state is told, least of all that of another frame";
  EXPECT_TRUE(in("c") == before);
  fs::remove(place.path() / "c/00000.png");
  EXPECT_EQ(place.rend(line + " -q --checkpoint-every 1e-9").code, 0);
  EXPECT_TRUE(in("c") == before) << "what was missing is there again, and nothing else is touched";
  EXPECT_THAT(place.rend("render clip.xml --resume -o c").err, HasSubstr("goes on at"));
  expect_same(in("c"), all, "");
}

// One frame for two shards: the first has none.
TEST_F(Resume, a_shard_without_frames_leaves_the_checkpoint_of_one_that_has_some) {
  NEEDS_PNG;
  const std::string line = "render clip.xml --set time.step=5e-5 -o c --shard 1/2";
  EXPECT_EQ(stopped_when("[ -e c/00000.png ]", line).code, 143);
  const Files before = in("c");
  ASSERT_TRUE(before.contains("clip.1-of-2.checkpoint"));
  const Outcome none = place.rend(line + " --resume --frames 5");
  EXPECT_EQ(none.code, 0) << none.err;
  EXPECT_THAT(none.out, HasSubstr("no frame was written"));
  EXPECT_TRUE(in("c") == before);
  EXPECT_THAT(place.rend(line + " --resume").err, HasSubstr("goes on at"));
}

TEST_F(Resume, a_shard_is_what_slurm_says_of_its_task) {
  NEEDS_PNG;
  const Files all = alone();
  for (int task : {10, 12, 14})
    EXPECT_EQ(place
                  .shell(fmt::format("SLURM_ARRAY_TASK_ID={} SLURM_ARRAY_TASK_COUNT=3 SLURM_ARRAY_TASK_MIN=10 "
                                     "SLURM_ARRAY_TASK_STEP=2 {} render clip.xml -q -o slurm",
                                     task, REND_PROGRAM))
                  .code,
              0);
  expect_same(in("slurm"), all, "");
}

TEST_F(Resume, refuses_what_is_no_shard_and_frames_that_run_backwards) {
  NEEDS_PNG;
  for (const char* words : {"--shard 5/3", "--shard 0/3", "--shard 3", "--shard 1/0", "--shard a/b",
                            "--shard -1/3", "--shard 1/2/3", "--frames 10-1", "--checkpoint-every -1"}) {
    const Outcome outcome = place.rend(std::string("render clip.xml -o x ") + words);
    EXPECT_EQ(outcome.code, 64) << words;
    EXPECT_THAT(outcome.err, HasSubstr("\n  hint: ")) << words;
    EXPECT_TRUE(in("x").empty()) << words;
  }
}

TEST_F(Resume, a_full_disk_leaves_whole_pictures_alone_and_going_on_makes_the_rest) {
  NEEDS_PNG;
  const Files all = alone();
  std::size_t least = std::string::npos, most = 0;
  for (const auto& [name, bytes] : all) {
    least = std::min(least, bytes.size());
    most = std::max(most, bytes.size());
  }
  const std::size_t blocks = most / 512 - (most % 512 == 0 ? 1 : 0); // of sh: less than the largest picture
  const Outcome outcome =
      place.shell(fmt::format("(ulimit -f {}; exec {} render clip.xml -q -o full)", blocks, REND_PROGRAM));
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
} // namespace rend
