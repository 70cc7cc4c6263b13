// The limits within which two pictures match, by the name of the metric.
//
// The names are those of tolerance files, the command line and reports. To add a limit on another metric, add a
// row to all_limits().
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
  bool leave_out_smoothed = false;      // edges that are smoothed differently (antialiasing.h)
  std::map<std::string, double> limits; // by name
  bool lifted = false; // "any" was given for a limit: if no other limit is left, anything matches
};
// The limits in effect, by name: where none was ever given, pictures must be equal.
const std::map<std::string, double>& limits_of(const Tolerance& tolerance);

// A metric outside its limit.
struct Excess {
  const Limit* limit;
  double asked, got;
  std::string text() const; // "share 0.012, at most 0.001"
};

// In the order of all_limits(); empty: the pictures match.
std::vector<Excess> excesses(const Tolerance& tolerance, const Metrics& metrics);

} // namespace rend
