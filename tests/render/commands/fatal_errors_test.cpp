// The program when memory runs out: exit code 75 and a message, promptly, and no incomplete files.
#include "render/console/fatal_errors.h"

#include "sim/base/error.h"
#include "tests/render/commands/program_run.h"
#include "tests/render/needs.h"
#include "tests/test_paths.h"

#include <csignal>
#include <gmock/gmock.h>
#include <new>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace rend::fatal_errors_test {
namespace {

using program::content;
using program::Outcome;
using program::TestFolder;
using testing::AllOf;
using testing::ExitedWithCode;
using testing::HasSubstr;

// Limits the address space of this process to so much more.
void bound_memory(rlim_t bytes) {
  const rlimit limit{bytes, bytes};
  ::setrlimit(RLIMIT_AS, &limit);
}

[[noreturn]] void throw_in_a_thread(const auto& error) {
  install_fatal_error_handlers();
  std::thread([&] { throw error; }).join(); // uncaught
  _exit(1);
}

TEST(LastResort, an_exception_that_no_one_can_catch_ends_with_its_code) {
  EXPECT_EXIT(throw_in_a_thread(std::bad_alloc()), ExitedWithCode(75), "not enough memory");
  EXPECT_EXIT(throw_in_a_thread(UserError(Exit::ReadWrite, {}, "of a disk", "free some")), ExitedWithCode(74),
              "rend: error: of a disk\n  hint: free some\n");
  EXPECT_EXIT(throw_in_a_thread(std::runtime_error("pthread_create has failed")), ExitedWithCode(75),
              "a thread could not be started");
  EXPECT_EXIT(throw_in_a_thread(std::logic_error("of ours")), ExitedWithCode(70),
              "fault of rend itself: of ours");
}

TEST(LastResort, a_crash_is_reported_as_out_of_memory_only_if_it_is) {
  for (const int signal : {SIGSEGV, SIGABRT})
    EXPECT_EXIT((install_fatal_error_handlers(), ::raise(signal)), testing::KilledBySignal(signal), "^$");
  for (const int signal : {SIGSEGV, SIGABRT})
    EXPECT_EXIT((install_fatal_error_handlers(), bound_memory(1 << 20), ::raise(signal)), ExitedWithCode(75),
                "rend: error: there is not enough memory");
}

class WithoutMemory : public testing::Test {
protected:
  WithoutMemory() { place.write("pulled.xml", program::pulled); }

  // With this limit of address space [MB]. A hanging program is killed after ten seconds (137).
  Outcome rend(int megabytes, const std::string& arguments) const {
    return place.shell("ulimit -v " + std::to_string(1000 * megabytes) + "; timeout -s KILL 10 " +
                       std::string(test::rend_program) + " " + arguments);
  }
  // The smallest limit, in steps, at which the program and its libraries start; it depends on the machine.
  int least_to_start(int step) const {
    int megabytes = step;
    while (rend(megabytes, "--version > /dev/null; exit $(($? == 127))").code != 0) megabytes += step;
    return megabytes;
  }
  bool done_or_refused(const Outcome& outcome, const std::string& when) const {
    EXPECT_THAT(outcome.code, testing::AnyOf(0, 75)) << when << "\n" << outcome.err;
    if (outcome.code == 75) {
      EXPECT_THAT(outcome.err, AllOf(HasSubstr("rend: error: "), HasSubstr("\n  hint: "))) << when;
    }
    for (const std::string& file : place.files())
      EXPECT_EQ(file.find(".part"), std::string::npos) << when << ": " << file;
    return outcome.code == 0;
  }

  const TestFolder place;
};

TEST_F(WithoutMemory, pictures_that_are_there_are_whole) {
  NEEDS_PNG;
  NEEDS_VIDEO;
  const std::string line = "render pulled.xml -q --video mp4 -o ";
  ASSERT_EQ(place.rend(line + "all").code, 0);
  int refused = 0;
  constexpr int step = 37;
  bool done = false;
  for (int megabytes = least_to_start(step); !done && megabytes < 4000; megabytes += step) {
    const std::string folder = std::to_string(megabytes);
    done = done_or_refused(rend(megabytes, line + folder), folder + " MB");
    refused += !done;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(place.path() / folder, error))
      EXPECT_EQ(content(entry.path()), content(place.path() / "all" / entry.path().filename())) << entry.path();
  }
  EXPECT_TRUE(done);
  EXPECT_GT(refused, 3);
}

TEST_F(WithoutMemory, a_simulation_too_large_is_refused) {
  const int megabytes = least_to_start(50) + 200;
  const Outcome outcome =
      rend(megabytes, "run pulled.xml -q --set body.sheet.cells='2000 2000' --events e.jsonl");
  EXPECT_EQ(outcome.code, 75);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("there is not enough memory"), HasSubstr("fewer cells")));
  EXPECT_EQ(place.files(), std::vector<std::string>{"pulled.xml"});
}

TEST_F(WithoutMemory, a_scene_that_no_machine_holds_is_refused) {
  for (const char* cells : {"1000000 1000000", "20000 20000"}) {
    const Outcome outcome = rend(2000, std::string("run pulled.xml --set body.sheet.cells='") + cells + "'");
    EXPECT_EQ(outcome.code, 65) << outcome.err;
  }
}

TEST_F(WithoutMemory, a_large_picture_is_not_the_presets_fault) {
  NEEDS_PNG;
  for (const char* samples : {"1", "4"}) {
    const Outcome outcome = rend(least_to_start(50) + 400, std::string("render pulled.xml -q -o deep/in --size "
                                                                       "8192x8192 --set image.samples=") +
                                                               samples);
    EXPECT_EQ(outcome.code, 75) << outcome.err;
    EXPECT_THAT(outcome.err,
                AllOf(HasSubstr("memory for a picture of 8192 x 8192"), HasSubstr("fewer samples")));
    EXPECT_EQ(place.files(), std::vector<std::string>{"pulled.xml"});
  }
}

TEST_F(WithoutMemory, a_comparison_is_refused_and_says_why) {
  NEEDS_PNG;
  ASSERT_EQ(place.rend("render pulled.xml -q --frames 0 --size 3000x3000 -o a").code, 0);
  const Outcome outcome = rend(least_to_start(50) + 100, "diff a a -o page");
  EXPECT_TRUE(!done_or_refused(outcome, "diff"));
  EXPECT_FALSE(std::filesystem::exists(place.path() / "page/index.html"));
}

TEST_F(WithoutMemory, a_check_ends_without_a_page_and_without_a_folder) {
  std::string large = program::pulled;
  large.replace(large.find("6 6"), 3, "1000 1000");
  place.write("large.xml", large);
  const Outcome outcome =
      place.shell("export TMPDIR=$PWD; ulimit -v " + std::to_string(1000 * (least_to_start(50) + 100)) +
                  "; timeout -s KILL 10 " + std::string(test::rend_program) + " check large.xml -q");
  EXPECT_FALSE(done_or_refused(outcome, "check"));
  EXPECT_EQ(place.files(), (std::vector<std::string>{"large.xml", "pulled.xml"}));
}

TEST_F(WithoutMemory, a_batch_tells_of_the_job_that_had_none) {
  NEEDS_PNG;
  const Outcome outcome = rend(least_to_start(50) + 60, "batch pulled.xml --json -q -o many");
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_EQ(outcome.json()["code"], 75) << outcome.out;
  EXPECT_THAT(outcome.json()["message"].get<std::string>(), HasSubstr("memory"));
}

} // namespace
} // namespace rend::fatal_errors_test
