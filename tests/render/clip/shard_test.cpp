// Sharded runs together give the bytes of a single run.
#include "tests/render/clip/stopped_clip.h"
#include "tests/render/needs.h"
#include "tests/test_paths.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace rend::shard_test {
namespace {

using program::Files;
using program::Outcome;
using testing::HasSubstr;

class Shards : public program::StoppedClip {};

TEST_F(Shards, shards_make_the_bytes_of_one_run) {
  NEEDS_PNG;
  const Files all = alone();
  for (int count : {1, 2, 3, 7, 40}) {
    const std::string folder = fmt::format("shards-{}", count);
    for (int n = 1; n <= count; ++n) {
      if (count == 40 && n > 2 && n < 39) continue; // with 40 shards, some have no frames
      EXPECT_EQ(place.rend(fmt::format("render clip.xml -q -o {} --shard {}/{}", folder, n, count)).code, 0);
    }
    count < 40 ? expect_same(in(folder), all, folder) : expect_part_of(in(folder), all, folder);
  }
}

// One frame and two shards: the first has none.
TEST_F(Shards, a_shard_without_frames_leaves_the_checkpoint_of_one_that_has_some) {
  NEEDS_PNG;
  const std::string line = "render clip.xml --set time.step=2e-5 -o c --shard 1/2";
  EXPECT_EQ(stopped_when("[ -e c/00000.png ]", line).code, 143);
  const Files before = in("c");
  ASSERT_TRUE(before.contains("clip.1-of-2.checkpoint"));
  const Outcome none = place.rend(line + " --resume --frames 5");
  EXPECT_EQ(none.code, 0) << none.err;
  EXPECT_THAT(none.out, HasSubstr("no frame was written"));
  EXPECT_TRUE(in("c") == before);
  EXPECT_THAT(place.rend(line + " --resume").err, HasSubstr("continuing at"));
}

TEST_F(Shards, a_shard_is_what_slurm_says_of_its_task) {
  NEEDS_PNG;
  const Files all = alone();
  for (int task : {10, 12, 14})
    EXPECT_EQ(place
                  .shell(fmt::format("SLURM_ARRAY_TASK_ID={} SLURM_ARRAY_TASK_COUNT=3 SLURM_ARRAY_TASK_MIN=10 "
                                     "SLURM_ARRAY_TASK_STEP=2 {} render clip.xml -q -o slurm",
                                     task, test::rend_program))
                  .code,
              0);
  expect_same(in("slurm"), all, "");
}

TEST_F(Shards, refuses_what_is_no_shard_and_frames_that_run_backwards) {
  NEEDS_PNG;
  for (const char* words : {"--shard 5/3", "--shard 0/3", "--shard 3", "--shard 1/0", "--shard a/b",
                            "--shard -1/3", "--shard 1/2/3", "--frames 10-1", "--checkpoint-every -1"}) {
    const Outcome outcome = place.rend(std::string("render clip.xml -o x ") + words);
    EXPECT_EQ(outcome.code, 64) << words;
    EXPECT_THAT(outcome.err, HasSubstr("\n  hint: ")) << words;
    EXPECT_TRUE(in("x").empty()) << words;
  }
}

} // namespace
} // namespace rend::shard_test
