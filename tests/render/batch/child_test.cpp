// A child process that runs this same program.
#include "render/batch/child.h"

#include "render/console/signals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace rend::child_test {
namespace {

constexpr const char* variable = "REND_TEST_WAITS";

TEST(Child, waits_when_it_is_one) {
  if (!std::getenv(variable)) GTEST_SKIP() << "it is none";
  while (true) ::pause();
}

// Some signals arrive before exec(): how many depends on the scheduler.
TEST(Child, is_ended_by_a_signal_however_early_it_comes) {
  const pid_t other = ::fork(); // which has signal handlers installed
  if (other == 0) {
    catch_signals();
    const GracefulStop graceful_stop;
    std::vector<Child> children;
    for (int n = 0; n < 60; ++n) {
      children.push_back(Child({"--gtest_filter=Child.waits_when_it_is_one"}, {{variable, "1"}}));
      children.back().signal(SIGTERM);
    }
    const auto runs = [](Child& child) { return child.running(); };
    for (int n = 0; n < 2000 && std::any_of(children.begin(), children.end(), runs); ++n)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    const bool all = std::all_of(children.begin(), children.end(),
                                 [](Child& child) { return !child.running() && child.code() == 143; });
    children.clear(); // kills those that still run
    ::_exit(all ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(other, &status, 0), other);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0) << "a job was not ended";
}

} // namespace
} // namespace rend::child_test
