#include "sim/base/profile.h"

#include "sim/base/archive.h"
#include "sim/base/enum_words.h"

#include <algorithm>
#include <limits>

namespace rend {

const char* name_of(Phase phase) {
  static constexpr EnumWords<Phase::Rest> words{"forces",    "loads",       "criteria",  "changes",
                                                "rebinding", "integration", "stiffness", "contact",
                                                "guard",     "output",      "rest"};
  return words[phase];
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

Profile::Profile(Extent extent) : extent_(extent), reading_(clock_reading()) {
  restart();
}

void Profile::restart() {
  state_ = every_step() ? State::Timed : State::Off;
  spent_.fill({});
  phase_ = Phase::Rest;
  since_ = Clock::now();
  steps_ = timed_steps_ = 0;
}

// The first step is not timed, as its caches are cold.
void Profile::begin_step(long number) {
  ++steps_;
  if (every_step()) {
    ++timed_steps_;
  } else if (number % sampled == sampled - 1) {
    ++timed_steps_;
    state_ = State::Timed;
    phase_ = Phase::Rest;
    since_ = Clock::now();
  }
}

void Profile::end_step() {
  if (!every_step()) state_ = State::Off;
}

bool Profile::enter(Phase phase, Phase& before) {
  if (state_ == State::Off && always_timed(phase)) {
    state_ = State::ChangeOnly;
    phase_ = Phase::Rest;
    since_ = Clock::now();
  } else if (state_ == State::Off || (state_ == State::ChangeOnly && !always_timed(phase))) {
    return false;
  }
  before = phase_;
  switch_to(phase);
  return true;
}

void Profile::leave(Phase before) {
  switch_to(before);
  if (state_ == State::ChangeOnly && before == Phase::Rest) state_ = State::Off;
}

void Profile::switch_to(Phase next) {
  const Clock::time_point now = Clock::now();
  const double seconds = std::chrono::duration<double>(now - since_).count() - reading_;
  spent_[static_cast<std::size_t>(phase_)].seconds += std::max(seconds, 0.0);
  ++spent_[static_cast<std::size_t>(next)].turns;
  phase_ = next;
  since_ = now;
}

double Profile::seconds(Phase phase) const {
  const double measured = spent(phase).seconds;
  if (always_timed(phase)) return measured;
  return timed_steps_ > 0 ? measured * static_cast<double>(steps_) / static_cast<double>(timed_steps_) : 0;
}

double Profile::total() const {
  double sum = 0;
  for (const Spent& spent : spent_) sum += spent.seconds;
  return sum;
}

void Profile::store(Archive& archive) {
  archive(steps_, timed_steps_);
  if (archive.reading()) refuse_unless(is_count(timed_steps_), "steps were timed less often than never");
  for (Spent& spent : spent_) archive(spent.seconds, spent.turns);
}

} // namespace rend
