#include "render/compare/limits.h"

#include "sim/base/check.h"

#include <algorithm>
#include <fmt/format.h>

namespace rend {

const std::vector<Limit>& all_limits() {
  using M = Metrics;
  using enum LimitKind;
  static const std::vector<Limit> limits{
      {"max", "levels", "largest difference of any channel", AtMost, 0, 255,
       [](const M& m) { return m.difference.max; }},
      {"mean", "levels", "mean difference", AtMost, 0, 255, [](const M& m) { return m.difference.mean; }},
      {"rmse", "levels", "root mean square difference", AtMost, 0, 255,
       [](const M& m) { return m.difference.rmse; }},
      {"psnr", "dB", "peak signal-to-noise ratio", AtLeast, 0, 1e3,
       [](const M& m) { return m.difference.psnr; }},
      {"ssim", "", "structural similarity", AtLeast, -1, 1, [](const M& m) { return m.ssim; }},
      {"flip", "", "mean of FLIP, a measure of how different pictures look (0 to 1)", AtMost, 0, 1,
       [](const M& m) { return m.flip.mean; }},
      {"flip-median", "", "weighted median of FLIP", AtMost, 0, 1, [](const M& m) { return m.flip.median; }},
      {"flip-max", "", "largest FLIP", AtMost, 0, 1, [](const M& m) { return m.flip.max; }},
      {"share", "", "share of the pixels that differ by more than the threshold", AtMost, 0, 1,
       [](const M& m) { return m.over.share; }},
      {"window", "", "the same share, within the window where it is highest", AtMost, 0, 1,
       [](const M& m) { return m.over.dense; }},
  };
  return limits;
}

const Limit* find_limit(const std::string& name) {
  const auto& all = all_limits();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Limit& limit) { return limit.name == name; });
  return found == all.end() ? nullptr : &*found;
}

std::string Excess::text() const {
  const std::string unit = limit->unit.empty() ? "" : " " + limit->unit;
  return fmt::format("{} {:.4g}, at {} {:.4g}{}", limit->name, got,
                     limit->kind == LimitKind::AtLeast ? "least" : "most", asked, unit);
}

const std::map<std::string, double>& limits_of(const Tolerance& tolerance) {
  static const std::map<std::string, double> equal{{"max", 0}};
  return tolerance.limits.empty() && !tolerance.lifted ? equal : tolerance.limits;
}

std::vector<Excess> excesses(const Tolerance& tolerance, const Metrics& metrics) {
  const auto& asked = limits_of(tolerance);
  for (const auto& [name, value] : asked) CHECK_NOTE(find_limit(name), name);
  std::vector<Excess> out;
  for (const Limit& limit : all_limits()) {
    const auto found = asked.find(limit.name);
    if (found == asked.end()) continue;
    const double got = limit.figure(metrics);
    if (limit.kind == LimitKind::AtLeast ? got < found->second : got > found->second)
      out.push_back({&limit, found->second, got});
  }
  return out;
}

} // namespace rend
