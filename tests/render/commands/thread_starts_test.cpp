// Commands on a system that allows few threads, or refuses one (failing_threads.cpp): they continue with fewer
// and say so, or end with 75. None hangs, crashes, or leaves incomplete files.
#include "tests/render/commands/program_run.h"
#include "tests/render/needs.h"
#include "tests/test_paths.h"

#include <gmock/gmock.h>
#include <thread>

namespace rend::thread_starts_test {
namespace {

using program::content;
using program::Outcome;
using program::TestFolder;
using testing::HasSubstr;

constexpr const char* fewer = "note: the system could not start all threads";

class ThreadStarts : public testing::Test {
protected:
  ThreadStarts() { place.write("pulled.xml", program::pulled); }

  // On a system with `limit` set; a hanging program is killed after ten seconds (137).
  Outcome rend(const std::string& limit, const std::string& arguments) const {
    const std::string system =
        limit + " REND_THREADS_MARK=refused LD_PRELOAD=" + std::string(test::failing_threads_library);
    return place.shell("timeout -s KILL 10 env " + system + " " + std::string(test::rend_program) + " " +
                       arguments);
  }
  static std::string at_most(int threads) { return "REND_MOST_THREADS=" + std::to_string(threads); }

  bool one_was_refused() const { return std::filesystem::remove(place.path() / "refused"); }

  // Exit code 0, or 75 with a message; returns whether it was 0.
  bool done_or_refused(const Outcome& outcome, const std::string& when) const {
    EXPECT_THAT(outcome.code, testing::AnyOf(0, 75)) << when << "\n" << outcome.err;
    if (outcome.code == 75) {
      EXPECT_THAT(outcome.err, testing::AllOf(HasSubstr("rend: error: "), HasSubstr("thread"),
                                              HasSubstr("could not be started"), HasSubstr("\n  hint: ")))
          << when;
    }
    for (const std::string& file : place.files())
      EXPECT_EQ(file.find(".part"), std::string::npos) << when << ": " << file;
    return outcome.code == 0;
  }

  const TestFolder place;
};

TEST_F(ThreadStarts, any_one_may_be_refused_for_a_moment) {
  NEEDS_PNG;
  NEEDS_VIDEO;
  const std::string line = "render pulled.xml -q --frames 0-2 --video mp4 -o ";
  int n = 0;
  do {
    ++n;
    const std::string folder = std::to_string(n);
    const Outcome outcome = rend("REND_THREAD_THAT_FAILS=" + folder, line + folder);
    EXPECT_EQ(outcome.code, 0) << "thread " << n << ": " << outcome.err;
    EXPECT_EQ(content(place.path() / folder / "00002.png"), content(place.path() / "1/00002.png"));
    EXPECT_EQ(content(place.path() / folder / "pulled.mp4"), content(place.path() / "1/pulled.mp4"));
  } while (one_was_refused());
  EXPECT_GT(n, 4); // drawing, two PNG writers, the video
}

TEST_F(ThreadStarts, pictures_are_made_with_fewer_or_refused_in_words) {
  NEEDS_PNG;
  NEEDS_VIDEO;
  const std::string line = "render pulled.xml --frames 0-2 --video mp4 -o ";
  ASSERT_EQ(place.rend(line + "all").code, 0);
  bool refused = true, refused_some = false, made_with_fewer = false;
  for (int most = 0; refused; ++most) {
    const std::string folder = std::to_string(most);
    const Outcome outcome = rend(at_most(most), line + folder);
    const bool done = done_or_refused(outcome, "with " + folder + " threads");
    refused = one_was_refused();
    refused_some |= !done;
    if (!done) {
      EXPECT_FALSE(std::filesystem::exists(place.path() / folder));
      continue;
    }
    if (refused) {
      EXPECT_THAT(outcome.err, HasSubstr(fewer));
    }
    made_with_fewer |= refused;
    for (const char* file : {"/00000.png", "/00002.png", "/pulled.mp4"})
      EXPECT_EQ(content(place.path() / (folder + file)), content(place.path() / (std::string("all") + file)));
  }
  EXPECT_TRUE(refused_some);
  EXPECT_TRUE(made_with_fewer);
}

TEST_F(ThreadStarts, a_simulation_goes_on_with_those_there_are) {
  const std::string line = "run pulled.xml --json --steps 5 --threads 2 --set time.step=2e-4 "
                           "--set body.sheet.cells='70 70'";
  const Outcome all = place.rend(line);
  ASSERT_EQ(all.code, 0) << all.err;
  for (const char* limit : {"REND_MOST_THREADS=0", "REND_THREAD_THAT_FAILS=1", "REND_THREAD_THAT_FAILS=2"}) {
    const Outcome outcome = rend(limit, line);
    ASSERT_EQ(outcome.code, 0) << limit << outcome.err;
    EXPECT_EQ(outcome.json()["hash"], all.json()["hash"]) << limit;
  }
  if (std::thread::hardware_concurrency() > 1) {
    EXPECT_THAT(rend(at_most(0), line).err, HasSubstr(fewer));
  }
}

TEST_F(ThreadStarts, comparisons_and_checks_go_on_with_those_there_are) {
  NEEDS_PNG;
  ASSERT_EQ(place.rend("render pulled.xml -q -o a").code, 0);
  for (const char* threads : {"2", "4"}) { // seven pictures: one after another, or several at once
    const Outcome outcome = rend(at_most(0), std::string("diff a a --threads ") + threads);
    EXPECT_TRUE(done_or_refused(outcome, threads));
    if (std::thread::hardware_concurrency() > 1) {
      EXPECT_THAT(outcome.err, HasSubstr(fewer));
    }
  }
  const Outcome check = rend(at_most(0), "check --quick --only stiffness --jobs 3 --json");
  EXPECT_TRUE(done_or_refused(check, "check"));
  EXPECT_THAT(check.err, HasSubstr(fewer));
  EXPECT_EQ(rend(at_most(0), "check --quick --only stiffness --jobs 3 --json -q").err, "");
}

TEST_F(ThreadStarts, a_batch_tells_of_jobs_that_had_none) {
  NEEDS_PNG;
  const Outcome outcome = rend(at_most(1), "batch pulled.xml --frames 0 --json -q -o many");
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_EQ(outcome.json()["code"], 75);
  EXPECT_THAT(outcome.json()["message"].get<std::string>(), HasSubstr("could not be started"));
  EXPECT_EQ(rend(at_most(12), "batch pulled.xml --frames 0 --json -q -o many").code, 0);
}

TEST_F(ThreadStarts, a_batch_goes_on_with_as_many_programs_as_there_are) {
  NEEDS_PNG;
  const std::string line = "batch pulled.xml --set body.mass.total=0.1,0.2,0.3 --jobs 3 --frames 0 -o many";
  const Outcome outcome = rend("REND_FORK_THAT_FAILS=2", line);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("3 of 3 jobs done"));
  EXPECT_THAT(outcome.err, HasSubstr("note: the system could not start as many jobs at once"));
  EXPECT_EQ(rend("REND_FORK_THAT_FAILS=1", line).code, 75);
}

} // namespace
} // namespace rend::thread_starts_test
