#include "render/console/progress.h"

#include "render/console/console.h"
#include "render/console/terminal.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <ctime>

namespace rend {
namespace {

constexpr double bar_every = 0.1, line_every = 10, window = 8; // [s]

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
  const ProgressParts told = parts(sample, time);
  // One column stays free, so that no terminal wraps; its width is asked each time, for it may change.
  if (const std::size_t columns = std::max<std::size_t>(terminal_columns(stderr).value_or(80), 5); terminal_)
    print_progress("\r" + bar_line(told, columns - 1, colour_) + "\033[K");
  else
    print_progress(fmt::format("{:3.0f}%  {}\n", 100 * told.share, fmt::join(told.pieces, "  ")));
  shown_ = terminal_;
  recent_.push_back(sample);
  while (recent_.size() > 2 && now - recent_.front().at > window) recent_.pop_front();
}

ProgressParts Progress::parts(const Sample& now, double time) const {
  ProgressParts out;
  out.share = steps_ > 0 ? std::min(1.0, static_cast<double>(now.step) / static_cast<double>(steps_)) : 1;
  const Sample& then = recent_.front();
  const double wall = now.at - then.at;
  if (now.step > then.step) {
    const double left =
        wall / static_cast<double>(now.step - then.step) * static_cast<double>(std::max(0L, steps_ - now.step));
    out.pieces.push_back(seconds_in_words(std::ceil(left)) + " left");
  }
  if (frames_ > 0) out.pieces.push_back(fmt::format("frame {} of {}", now.frame, frames_));
  out.pieces.push_back(fmt::format("{:.2f} of {:.2f} s", time, duration_));
  if (frames_ > 0 && now.frame > then.frame)
    out.pieces.push_back(
        fmt::format("{:.0f} ms/frame", 1e3 * wall / static_cast<double>(now.frame - then.frame)));
  return out;
}

std::string bar_line(const ProgressParts& parts, std::size_t columns, bool colour) {
  constexpr std::size_t widest = 24, narrowest = 8, percent = 4; // columns
  std::string text = fmt::format("{:3.0f}%", 100 * parts.share);
  std::size_t used = percent;
  for (const std::string& piece : parts.pieces) {
    if (used + 2 + piece.size() > columns) break;
    text += "  " + piece;
    used += 2 + piece.size();
  }
  const std::size_t room = columns > used ? columns - used - 1 : 0; // a blank behind the bar
  if (room < narrowest) return text;
  const std::size_t width = std::min(room, widest);
  const auto full = static_cast<std::size_t>(parts.share * static_cast<double>(width));
  return fmt::format("{}{}{}{} ", colour ? "\033[36m" : "", std::string(full, '='), colour ? "\033[0m" : "",
                     std::string(width - full, '.')) +
         text;
}

} // namespace rend
