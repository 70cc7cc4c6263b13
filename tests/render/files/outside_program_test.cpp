// Other programs: what they say, how they end, and that nothing of them outlives the time for them.
#include "render/files/outside_program.h"

#include "sim/base/error.h"
#include "sim/base/wall_clock.h"
#include "tests/render/pictures.h"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>

namespace rend::outside_program_test {
namespace {

namespace fs = std::filesystem;

class OutsideProgram : public testing::Test {
protected:
  std::optional<ProgramOutcome> run(const std::string& script, double most = 60) const {
    return run_outside_program({"sh", "-c", script}, fs::path(folder_ / "."), most, [] { return false; });
  }
  const test::Folder folder_;
};

TEST_F(OutsideProgram, tells_its_words_and_its_exit_code) {
  const auto outcome = run("echo out; echo err >&2; read line || echo nothing to read; exit 3");
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome->code, 3);
  EXPECT_EQ(outcome->said, "out\nerr\nnothing to read\n");
  EXPECT_EQ(run("kill -SEGV $$")->code, 128 + SIGSEGV);
  EXPECT_EQ(run("touch there")->code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "there")) << "it runs in its folder";
}

TEST_F(OutsideProgram, is_found_as_a_shell_finds_it) {
  const auto start = [&](const std::string& name) {
    return run_outside_program({name}, fs::path(folder_ / "."), 60, [] { return false; });
  };
  EXPECT_FALSE(start("no-such-program-of-anybody"));
  std::ofstream(folder_ / "rubbish") << "no program";
  EXPECT_FALSE(start(folder_ / "rubbish")) << "nobody may run it";
  fs::permissions(folder_ / "rubbish", fs::perms::owner_all);
  EXPECT_THROW(start(folder_ / "rubbish"), UserError);
}

TEST_F(OutsideProgram, of_many_words_the_last_are_kept) {
  const auto outcome = run("yes many words | head -c 100000000; echo the end");
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome->code, 0);
  EXPECT_EQ(outcome->said.size(), 65536u);
  EXPECT_TRUE(outcome->said.ends_with("the end\n"));
}

TEST_F(OutsideProgram, is_ended_in_time_whatever_it_writes) {
  for (const char* script : {"yes", "exec >&- 2>&-; sleep 60", "trap '' TERM; sleep 60 & sleep 60"}) {
    const double start = wall_clock();
    EXPECT_EQ(run(script, 0.3)->end, ProgramOutcome::End::TimeLimit) << script;
    EXPECT_LT(wall_clock() - start, 3) << script;
  }
}

} // namespace
} // namespace rend::outside_program_test
