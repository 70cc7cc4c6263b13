#include "sim/rows/row_times.h"

#include <algorithm>

namespace rend {

void RowTimes::take(const std::vector<double>& seconds) {
  const std::lock_guard lock(mutex_);
  for (std::size_t n = 0; n < seconds.size(); ++n) seconds_[n] += seconds[n];
}

RowTimes::Laps::Laps(RowTimes* times) : times_(times) {
  if (times_) seconds_.resize(times_->seconds_.size());
}

RowTimes::Laps::~Laps() {
  if (times_) times_->take(seconds_);
}

void RowTimes::Laps::add(std::size_t interaction) {
  const Clock::time_point now = Clock::now();
  const double seconds = std::chrono::duration<double>(now - since_).count() - times_->reading_;
  seconds_[interaction] += std::max(seconds, 0.0);
  since_ = now;
}

} // namespace rend
