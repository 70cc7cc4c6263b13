#include "sim/base/profile.h"

#include <algorithm>
#include <limits>

namespace rend {

const char* name_of(Stage stage) {
  static constexpr std::array<const char*, stage_count> names{
      "forces",    "loads",   "criteria", "changes", "rebinding", "integration",
      "stiffness", "contact", "guard",    "output",  "rest"};
  return names[static_cast<std::size_t>(stage)];
}

double clock_reading() {
  using Clock = std::chrono::steady_clock;
  double least = std::numeric_limits<double>::infinity();
  for (int tries = 0; tries < 200; ++tries) {
    const Clock::time_point first = Clock::now(), second = Clock::now();
    least = std::min(least, std::chrono::duration<double>(second - first).count());
  }
  return least;
}

Profile::Profile() : reading_(clock_reading()) {
  restart();
}

void Profile::restart() {
  spent_.fill({});
  stage_ = Stage::Rest;
  since_ = Clock::now();
}

Stage Profile::turn_to(Stage next) {
  const Clock::time_point now = Clock::now();
  const Stage before = stage_;
  const double seconds = std::chrono::duration<double>(now - since_).count() - reading_;
  spent_[static_cast<std::size_t>(before)].seconds += std::max(seconds, 0.0);
  ++spent_[static_cast<std::size_t>(next)].turns;
  stage_ = next;
  since_ = now;
  return before;
}

double Profile::total() const {
  double sum = 0;
  for (const Spent& spent : spent_) sum += spent.seconds;
  return sum;
}

} // namespace rend
