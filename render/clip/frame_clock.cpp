#include "render/clip/frame_clock.h"

#include "sim/base/check.h"
#include "sim/base/error.h"
#include "sim/base/wording.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

namespace rend {
namespace {

// Times are products of rounded numbers: smaller differences count as equal.
constexpr double slack = 1e-12;

std::optional<long> whole_number(std::string_view text) {
  long value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || text.empty() || value < 0) return {};
  return value;
}

} // namespace

FrameClock::FrameClock(double duration, double step, double fps, Playback playback, Shutter shutter)
    : duration_(duration), step_(step), fps_(fps), playback_(std::move(playback)), shutter_(shutter) {
  CHECK(shutter.open >= 0 && shutter.open <= 1 && shutter.samples > 0);
  CHECK(duration >= 0 && step > 0 && fps > 0 && duration / step < 1e15 && clip_duration() * fps < 1e15);
  steps_ = static_cast<long>(std::ceil(duration / step * (1 - slack)));
  frames_ = static_cast<long>(std::floor(clip_duration() * fps * (1 + slack))) + 1;
}

long FrameClock::step_at(double time) const {
  return std::min(static_cast<long>(std::ceil(time / step_ * (1 - slack))), steps_);
}

long FrameClock::step_of(long frame) const {
  return step_at(time_of(frame));
}

std::vector<Moment> FrameClock::moments_of(long frame) const {
  std::vector<Moment> moments;
  if (!has_shutter()) return moments;
  const long earliest = frame > 0 ? step_of(frame - 1) : 0;
  for (int n = 0; n < shutter_.samples; ++n) {
    const double before = shutter_.open * (1 - (n + 0.5) / shutter_.samples); // [frames]
    const double time = playback_.simulated(std::max(static_cast<double>(frame) - before, 0.0) / fps_);
    moments.push_back(
        {.time = frame > 0 ? time : 0, .step = frame > 0 ? std::max(step_at(time), earliest) : 0});
  }
  const bool between = moments.back().time - moments.front().time < (shutter_.samples - 1) * step_;
  for (Moment& moment : moments)
    if (between && moment.step > earliest)
      moment.share = std::clamp(moment.time / step_ - static_cast<double>(moment.step - 1), 0.0, 1.0);
  return moments;
}

long FrameClock::first_step(long frame) const {
  if (!has_shutter() || frame >= frames_) return step_of(frame);
  const Moment first = moments_of(frame).front();
  return first.share < 1 ? first.step - 1 : first.step;
}

FrameChoice::FrameChoice(const std::string& text) : all_(false) {
  const auto fail = [&](const std::string& what) {
    throw UserError(Exit::Usage, {}, fmt::format("--frames {}: {}", in_quotes(text), what),
                    "write frames as 7, 0-100, 0-100x2 (every second), 10- (to the end) or 0,5,20-30");
  };
  for (std::string_view rest = text; !rest.empty() || ranges_.empty();) {
    std::string_view part = rest.substr(0, rest.find(','));
    if (part.size() + 1 == rest.size()) fail("it ends with a comma");
    rest.remove_prefix(std::min(part.size() + 1, rest.size()));
    Range range;
    const std::size_t dash = part.find('-'), times = part.find('x');
    if (times != std::string_view::npos) {
      const auto stride = whole_number(part.substr(times + 1));
      if (!stride || *stride == 0 || dash == std::string_view::npos) fail(in_quotes(part) + " is not a range");
      range.stride = *stride;
      part = part.substr(0, times);
    }
    const auto first = whole_number(part.substr(0, dash));
    auto last = first;
    if (dash != std::string_view::npos)
      last = dash + 1 == part.size() ? std::numeric_limits<long>::max() : whole_number(part.substr(dash + 1));
    if (!first || !last) fail(in_quotes(part) + " is neither a frame nor a range");
    if (*last < *first) fail(in_quotes(part) + " runs backwards");
    range.first = *first;
    range.last = *last;
    ranges_.push_back(range);
  }
}

bool FrameChoice::has(long frame) const {
  return all_ || std::any_of(ranges_.begin(), ranges_.end(), [&](const Range& range) {
           return frame >= range.first && frame <= range.last && (frame - range.first) % range.stride == 0;
         });
}

long FrameChoice::last(long frames) const {
  if (all_) return frames - 1;
  long best = -1;
  for (const Range& range : ranges_) {
    const long end = std::min(range.last, frames - 1);
    if (end >= range.first) best = std::max(best, end - (end - range.first) % range.stride);
  }
  return best;
}

long last_chosen(const FrameChoice& choice, const FrameClock& clock) {
  const long last = choice.last(clock.frames());
  if (last < 0)
    throw UserError(Exit::Usage, {}, "--frames names no frame of this clip",
                    clock.frames() == 1 ? std::string("it has frame 0 alone")
                                        : fmt::format("it has frames 0 to {}", clock.frames() - 1));
  return last;
}

PictureSize parse_size(const std::string& text) {
  const std::size_t cross = std::min(text.find('x'), text.size());
  const auto width = whole_number(std::string_view(text).substr(0, cross));
  const auto height = whole_number(std::string_view(text).substr(std::min(cross + 1, text.size())));
  const auto fits = [](std::optional<long> side) { return side && *side >= 16 && *side <= 8192; };
  if (!fits(width) || !fits(height))
    throw UserError(Exit::Usage, {}, fmt::format("--size {} is not a picture size", in_quotes(text)),
                    "write it as 1280x720; each side has 16 to 8192 pixels");
  return {static_cast<int>(*width), static_cast<int>(*height)};
}

} // namespace rend
