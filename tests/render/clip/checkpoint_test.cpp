// Checkpoints: which ones a run resumes from, what they contain, and which are left alone.
#include "render/clip/checkpoint.h"

#include "render/clip/frame_output.h"
#include "render/clip/session.h"
#include "sim/base/error.h"
#include "tests/render/clip/stopped_clip.h"
#include "tests/render/needs.h"
#include "tests/test_paths.h"

#include <gmock/gmock.h>

namespace rend::checkpoint_test {
namespace {

using program::content;
using program::Files;
using program::Outcome;
using program::TestFolder;
using testing::HasSubstr;
namespace fs = std::filesystem;

class Checkpoint : public program::StoppedClip {};

TEST_F(Checkpoint, a_checkpoint_of_something_else_is_refused_and_nothing_is_lost) {
  NEEDS_PNG;
  alone();
  stop_midway("c");
  const Files before = in("c");
  for (const char* other : {"--set body[cloth].mass.total=0.2", "--size 80x60", "--kernels walk", "--fps 50"}) {
    const Outcome outcome = place.rend(std::string("render clip.xml -q --resume -o c ") + other);
    EXPECT_EQ(outcome.code, 65) << other;
    EXPECT_THAT(outcome.err,
                testing::AllOf(HasSubstr("c/clip.checkpoint"), HasSubstr("made from another preset"),
                               HasSubstr("leave out --resume")));
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

// It produces the same pictures, but its checkpoint belongs to its own program file.
TEST_F(Checkpoint, another_build_of_the_same_commit_keeps_pictures_and_no_state) {
  NEEDS_PNG;
  const Files all = alone();
  EXPECT_EQ(place.shell(fmt::format("cp {} other && echo built anew >> other", test::rend_program)).code, 0);
  const Outcome whole = place.shell("./other render clip.xml -q --resume -o alone --json");
  EXPECT_EQ(whole.code, 0) << whole.err;
  EXPECT_EQ(whole.json()["kept"], all.size());
  expect_same(in("alone"), all, "");

  stop_midway("stopped");
  const Files before = in("stopped");
  const Outcome refused = place.shell("./other render clip.xml -q --resume -o stopped");
  EXPECT_EQ(refused.code, 65);
  EXPECT_THAT(refused.err, HasSubstr("another build of rend"));
  expect_same(in("stopped"), before, "");
}

TEST_F(Checkpoint, fewer_frames_leave_the_checkpoint_of_a_later_one_alone) {
  NEEDS_PNG;
  const Files all = alone();
  stop_midway("c");
  const Files before = in("c");
  const std::string line = "render clip.xml --resume -o c --frames 0";
  const Outcome there = place.rend(line + " --json");
  EXPECT_EQ(there.code, 0) << there.err;
  EXPECT_THAT(there.err, HasSubstr("clip.checkpoint is of a later frame than those asked for"));
  EXPECT_EQ(there.json()["kept"], 1);
  EXPECT_TRUE(there.json()["steps"].is_null()) << "no state is told, least of all that of another frame";
  EXPECT_TRUE(in("c") == before);
  fs::remove(place.path() / "c/00000.png");
  EXPECT_EQ(place.rend(line + " -q --checkpoint-every 1e-9").code, 0);
  EXPECT_TRUE(in("c") == before) << "what was missing is there again, and nothing else is touched";
  EXPECT_THAT(place.rend("render clip.xml --resume -o c").err, HasSubstr("continuing at"));
  expect_same(in("c"), all, "");
}

// A run in this process that writes no pictures.
struct LocalRun {
  Session session;
  FrameOutput output;
  std::string key;
  explicit LocalRun(const TestFolder& place)
      : session(quietly(place)), output(session, files_in(place), FramePlan{}),
        key(picture_key(session, 64, 48, 1)) {}
  static SessionOptions quietly(const TestFolder& place) {
    SessionOptions options;
    options.preset = (place.path() / "clip.xml").string();
    options.quiet = true;
    return options;
  }
  static PipelineOptions files_in(const TestFolder& place) {
    PipelineOptions files;
    files.folder = place.path() / "c";
    files.width = 64;
    files.height = 48;
    files.png = false;
    return files;
  }
};

TEST_F(Checkpoint, a_checkpoint_s_next_frame_and_state_are_of_the_same_bytes) {
  const fs::path path = place.path() / "one.checkpoint";
  LocalRun from(place), to(place);
  from.session.run(5, {[](long) {}, {}});
  write_checkpoint(path, from.key, 6, from.session, from.output);
  const std::uint64_t fresh = to.session.scene().hash();
  EXPECT_FALSE(read_checkpoint(path, to.key, 5, to.session, to.output)) << "rewritten since it was found";
  EXPECT_FALSE(read_checkpoint(path, "1", 30, to.session, to.output));
  EXPECT_FALSE(read_checkpoint(place.path() / "gone.checkpoint", to.key, 30, to.session, to.output));
  EXPECT_EQ(to.session.scene().hash(), fresh);
  const auto head = read_checkpoint(path, to.key, 30, to.session, to.output);
  ASSERT_TRUE(head);
  EXPECT_EQ(head->next, 6);
  EXPECT_EQ(to.session.scene().hash(), from.session.scene().hash());

  const std::string bytes = content(path);
  for (std::size_t n = bytes.find('\n') + 1, end = n + 16; n < end; ++n) { // key, next frame
    std::string other = bytes;
    other[n] = static_cast<char>(other[n] ^ 1);
    place.write("one.checkpoint", other);
    EXPECT_THROW(read_checkpoint(path, to.key, 30, to.session, to.output), UserError) << "byte " << n;
  }
  write_checkpoint(path, from.key, 7, from.session, from.output); // a state before frame 6
  EXPECT_THROW(read_checkpoint(path, to.key, 30, to.session, to.output), UserError);
}

TEST_F(Checkpoint, the_best_checkpoint_is_the_run_s_own_then_the_latest_of_the_others) {
  LocalRun run(place);
  fs::create_directories(place.path() / "c");
  const auto write = [&](const char* name, long next) {
    write_checkpoint(place.path() / "c" / name, run.key, next, run.session, run.output);
  };
  const auto found = [&](long first, const Shard& shard) {
    std::vector<std::string> names;
    for (const auto& one : find_checkpoints(place.path() / "c", "clip", shard, run.key, first))
      names.push_back(one.path.filename().string());
    return names;
  };
  EXPECT_TRUE(found(30, {}).empty());
  write("clip.1-of-3.checkpoint", 3);
  write("clip.12-of-20.checkpoint", 9);
  write("clip.3-of-3.checkpoint", 20);
  place.write("c/clip.2-of-2.checkpoint", "hello");
  EXPECT_THAT(found(10, {}), testing::ElementsAre("clip.12-of-20.checkpoint", "clip.1-of-3.checkpoint"));
  write("clip.2-of-3.checkpoint", 5);
  EXPECT_THAT(found(10, {2, 3}), testing::ElementsAre("clip.2-of-3.checkpoint", "clip.12-of-20.checkpoint",
                                                      "clip.1-of-3.checkpoint"));
  EXPECT_THAT(found(4, {2, 3}), testing::ElementsAre("clip.1-of-3.checkpoint"));
}

TEST_F(Checkpoint, only_files_that_a_run_of_this_name_writes_are_looked_at) {
  LocalRun run(place);
  fs::create_directories(place.path() / "c");
  for (const char* name :
       {"other.checkpoint", "clip", "clipped.checkpoint", "clip.1-of-2.checkpoint.part",
        "clip.0-of-2.checkpoint", "clip.3-of-2.checkpoint", "clip.01-of-2.checkpoint",
        "clip.+1-of-2.checkpoint", "clip.1-of-.checkpoint", "clip.1of2.checkpoint",
        "clip.1-of-2.extra.checkpoint", "clip.-1-of-2.checkpoint", "clip.99999999999999999999-of-2.checkpoint",
        ".checkpoint", "clip.1-of-2.checkpoin", "clip.1-of-1.checkpoint"})
    write_checkpoint(place.path() / "c" / name, run.key, 3, run.session, run.output);
  const auto found = [&] { return find_checkpoints(place.path() / "c", "clip", {2, 9}, run.key, 30); };
  EXPECT_TRUE(found().empty()) << found().front().path;
  write_checkpoint(place.path() / "c/clip.checkpoint", run.key, 3, run.session, run.output);
  write_checkpoint(place.path() / "c/clip.1-of-2.checkpoint", run.key, 3, run.session, run.output);
  EXPECT_EQ(found().size(), 2u);
}

// A FIFO is not waited for, and a link is not followed.
TEST_F(Checkpoint, what_is_no_regular_file_is_refused_and_of_others_left_out) {
  LocalRun run(place);
  fs::create_directories(place.path() / "c");
  const fs::path own = place.path() / "c/clip.checkpoint", genuine = place.path() / "genuine";
  write_checkpoint(genuine, run.key, 3, run.session, run.output);
  const std::map<std::string, std::string> kinds{
      {"a pipe", "mkfifo {}"}, {"a folder", "mkdir {}"}, {"a symbolic link", "ln -s ../genuine {}"}};
  for (const auto& [kind, command] : kinds) {
    EXPECT_EQ(place.shell(fmt::format(fmt::runtime(command), own.string())).code, 0);
    const auto said = [&](const auto& reads) -> std::string {
      try {
        reads();
      } catch (const UserError& error) {
        EXPECT_EQ(error.code, Exit::BadInput);
        return error.what();
      }
      return "nothing";
    };
    const std::string why = "a checkpoint is a regular file, and this is " + kind;
    EXPECT_THAT(said([&] { read_checkpoint_header(own, run.key); }), HasSubstr(why));
    EXPECT_THAT(said([&] { read_checkpoint(own, run.key, 30, run.session, run.output); }), HasSubstr(why));
    EXPECT_THAT(said([&] { find_checkpoints(place.path() / "c", "clip", {}, run.key, 30); }), HasSubstr(why));
    EXPECT_TRUE(find_checkpoints(place.path() / "c", "clip", {1, 2}, run.key, 30).empty()) << kind;
    if (png_available()) {
      const Outcome outcome = place.rend("render clip.xml -q --resume -o c");
      EXPECT_EQ(outcome.code, 65) << kind;
      EXPECT_THAT(outcome.err, HasSubstr(why));
    }
    fs::remove_all(own);
  }
  EXPECT_TRUE(fs::exists(genuine));
}

// A sparse file of a terabyte.
TEST_F(Checkpoint, a_file_that_is_nearly_all_holes_takes_neither_time_nor_memory) {
  LocalRun from(place), to(place);
  const fs::path path = place.path() / "one.checkpoint";
  from.session.run(5, {[](long) {}, {}});
  write_checkpoint(path, from.key, 6, from.session, from.output);
  const std::string bytes = content(path);
  for (const std::size_t kept : {bytes.size(), bytes.size() / 2, std::size_t{50}}) {
    place.write("one.checkpoint", bytes.substr(0, kept));
    fs::resize_file(path, std::uintmax_t{1} << 40U);
    EXPECT_THROW(read_checkpoint(path, to.key, 30, to.session, to.output), UserError) << kept;
  }
}

} // namespace
} // namespace rend::checkpoint_test
