#include "render/console/time_limit.h"

#include "render/console/console.h"
#include "render/files/temporaries.h"
#include "sim/base/error.h"
#include "sim/base/wall_clock.h"

#include <fmt/format.h>

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <system_error>
#include <utility>

namespace rend {
namespace {

constexpr double a_moment = 0.25; // [s]: for what asks, and ends by itself

} // namespace

TimeLimit::TimeLimit(double seconds, const std::string& what, std::string hint)
    : end_(wall_clock() + seconds), what_(fmt::format("{} took longer than {:g} s", what, seconds)),
      hint_(std::move(hint)) {
  try {
    watch_ = std::jthread([this](const std::stop_token& over) { watch(over); });
  } catch (const std::system_error&) { // no thread is to be had: the limit is that of the parts that ask
  }
}

double TimeLimit::left() const {
  return end_ - wall_clock();
}

void TimeLimit::fail() const {
  throw UserError(Exit::OutOfBudget, {}, what_, hint_);
}

void TimeLimit::check() const {
  if (left() <= 0) fail();
}

void TimeLimit::watch(const std::stop_token& over) const {
  std::mutex mutex;
  std::unique_lock lock(mutex);
  std::condition_variable_any ended;
  const auto time = std::chrono::duration<double>(left() + a_moment);
  ended.wait_for(lock, over, time, [] { return false; });
  if (over.stop_requested()) return;
  print_error(what_, hint_);
  remove_temporaries();
  std::_Exit(static_cast<int>(Exit::OutOfBudget));
}

} // namespace rend
