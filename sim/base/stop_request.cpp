#include "sim/base/stop_request.h"

#include <atomic>
#include <ctime>

namespace rend {
namespace {

std::atomic<double> due_at = 0; // [s], monotonic: the end of the grace; 0: nobody has asked for a stop
static_assert(std::atomic<double>::is_always_lock_free);

double now() noexcept {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

} // namespace

void request_stop(double grace) noexcept {
  double none = 0;
  due_at.compare_exchange_strong(none, now() + grace);
}

void withdraw_stop() noexcept {
  due_at = 0;
}

bool stop_is_due() noexcept {
  const double at = due_at.load(std::memory_order_relaxed);
  return at != 0 && now() > at;
}

void throw_if_stop_is_due() {
  if (stop_is_due()) throw StopRequested{};
}

} // namespace rend
