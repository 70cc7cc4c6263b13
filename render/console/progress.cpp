#include "render/console/progress.h"

#include "render/console/console.h"

#include <fmt/format.h>

#include <cmath>
#include <ctime>

namespace rend {
namespace {

constexpr double bar_every = 0.1, line_every = 5, window = 8; // [s]

double coarse_now() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC_COARSE, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

} // namespace

Progress::Progress(bool quiet, long steps, double duration, long frames)
    : quiet_(quiet), terminal_(is_terminal(stderr)), colour_(wants_colour(stderr)), steps_(steps),
      frames_(frames), duration_(duration) {
  const double now = coarse_now();
  next_ = now + (terminal_ ? bar_every : line_every);
  recent_.push_back({now, 0, 0});
}

Progress::~Progress() {
  clear();
}

void Progress::clear() {
  if (shown_) print_progress("\r\033[K");
  shown_ = false;
}

void Progress::update(long step, double time, long frame) {
  if (quiet_) return;
  const double now = coarse_now();
  if (now < next_) return;
  next_ = now + (terminal_ ? bar_every : line_every);
  const Sample sample{now, step, frame};
  const std::string text = line(sample, time);
  print_progress(terminal_ ? "\r" + text + "\033[K" : text + "\n");
  shown_ = terminal_;
  recent_.push_back(sample);
  while (recent_.size() > 2 && now - recent_.front().at > window) recent_.pop_front();
}

std::string Progress::line(const Sample& now, double time) const {
  const double share =
      steps_ > 0 ? std::min(1.0, static_cast<double>(now.step) / static_cast<double>(steps_)) : 1;
  std::string text;
  if (terminal_) {
    constexpr int width = 24;
    const int full = static_cast<int>(share * width);
    text = fmt::format("{}{}{}{} ", colour_ ? "\033[36m" : "", std::string(full, '='), colour_ ? "\033[0m" : "",
                       std::string(width - full, '.'));
  }
  text += fmt::format("{:3.0f}%  {:.2f} of {:.2f} s", 100 * share, time, duration_);
  if (frames_ > 0) text += fmt::format("  frame {} of {}", now.frame, frames_);
  const Sample& then = recent_.front();
  const double wall = now.at - then.at;
  if (frames_ > 0 && now.frame > then.frame)
    text += fmt::format("  {:.0f} ms/frame", 1e3 * wall / static_cast<double>(now.frame - then.frame));
  if (now.step > then.step) {
    const double left =
        wall / static_cast<double>(now.step - then.step) * static_cast<double>(std::max(0L, steps_ - now.step));
    text += "  " + seconds_in_words(std::ceil(left)) + " left";
  }
  return text;
}

} // namespace rend
