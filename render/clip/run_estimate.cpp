#include "render/clip/run_estimate.h"

#include <fmt/format.h>

namespace rend {
namespace {

constexpr double enough = 1;  // [s] of steps
constexpr double hour = 3600; // [s]

} // namespace

std::optional<double> RunEstimate::add(double seconds) {
  if (!open_) return {};
  --left_;
  if (made_++ == 0 && seconds < enough) return {};
  ++counted_;
  sum_ += seconds;
  if (sum_ < enough) return {};
  open_ = false;
  const double all = sum_ / static_cast<double>(counted_) * static_cast<double>(left_);
  return all >= hour ? std::optional(all) : std::nullopt;
}

std::string hours_in_words(double seconds) {
  const double hours = seconds / hour;
  const std::string words =
      hours < 10 ? fmt::format("{:.1f} hours", hours) : fmt::format("{:.0f} hours", hours);
  return hours < 48 ? words : words + fmt::format(" ({:.0f} days)", hours / 24);
}

} // namespace rend
