// What two pictures may differ by and still match: limits on figures, by name.
//
// The names stand in tolerance files, on the command line and in reports. Another figure that can be limited is
// one row in all_limits().
#pragma once

#include "render/compare/metrics.h"

#include <map>
#include <string>
#include <vector>

namespace rend {

// What the figure must be against the limit: at least of PSNR and SSIM.
enum class LimitKind { AtMost, AtLeast };

struct Limit {
  std::string name; // "share"
  std::string unit; // "levels", "dB" or none
  std::string what; // "mean of FLIP"
  LimitKind kind;
  double low, high; // bounds of what can be asked for
  double (*figure)(const Metrics& metrics);
};
const std::vector<Limit>& all_limits();
const Limit* find_limit(const std::string& name); // null if there is none

struct Tolerance {
  double threshold = 0;                 // [levels] see MeasureOptions
  int window_side = 16;                 // [pixels]
  std::map<std::string, double> limits; // by name
  bool lifted = false;                  // "any" was said of a limit: where no other is left, anything matches
};
// Those that hold, by name: where none was ever spoken of pictures must be equal.
const std::map<std::string, double>& limits_of(const Tolerance& tolerance);

// A figure outside its limit.
struct Excess {
  const Limit* limit;
  double asked, got;
  std::string text() const; // "share 0.012, at most 0.001"
};

// In the order of all_limits(); empty: the pictures match.
std::vector<Excess> excesses(const Tolerance& tolerance, const Metrics& metrics);

} // namespace rend
