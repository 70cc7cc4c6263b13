// The findings at the top of a study's page.
#include "render/console/console.h"
#include "render/pages/study_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

std::string time_in_words(double seconds) {
  if (seconds < 1e-3) return fmt::format("{:.3g} µs", 1e6 * seconds);
  if (seconds < 1) return fmt::format("{:.3g} ms", 1e3 * seconds);
  return seconds_in_words(seconds);
}

std::string power_of_ten(double error) {
  return fmt::format("1e{}", std::lround(std::log10(error)));
}

std::string share_in_words(double error) {
  return fmt::format("{:g} % of the motion ({})", 100 * error, power_of_ten(error));
}

struct Reached {
  const StudyCurve* curve;
  Reach reach;
};

// The schemes that reach the target in this group, the fastest first.
std::vector<Reached> reached(const StudyReport& report, std::size_t group, std::size_t target) {
  std::vector<Reached> all;
  for (const StudyCurve& curve : report.curves)
    if (curve.group == group && curve.reach[target]) all.push_back({&curve, *curve.reach[target]});
  std::stable_sort(all.begin(), all.end(),
                   [](const Reached& a, const Reached& b) { return a.reach.seconds < b.reach.seconds; });
  return all;
}

// "3.4", "28", "270": two significant digits.
std::string times_in_words(double factor) {
  return factor < 9.95 ? fmt::format("{:.1f}", factor)
                       : fmt::format("{:.0f}", factor < 100 ? factor : 10 * std::round(factor / 10));
}

std::string cheapest(const StudyReport& report, std::size_t group, std::size_t target) {
  const std::vector<Reached> all = reached(report, group, target);
  const std::string to = share_in_words(report.targets[target]);
  if (all.empty()) return fmt::format("No run comes within {}.", to);
  const Reached &first = all.front(), &last = all.back();
  std::string out = fmt::format("To come within {}, {} is the cheapest: {}{}", to, first.curve->integrator,
                                time_in_words(first.reach.seconds),
                                first.reach.at_most ? ", already by its largest step that holds" : "");
  if (all.size() == 1) return out + "; no other scheme gets there.";
  out += fmt::format("; {} takes {} times as long", all[1].curve->integrator,
                     times_in_words(all[1].reach.seconds / first.reach.seconds));
  if (all.size() > 2)
    out += fmt::format(", {} {} times", last.curve->integrator,
                       times_in_words(last.reach.seconds / first.reach.seconds));
  return out + ".";
}

std::string joined(const std::vector<std::string>& parts) {
  std::string out;
  for (std::size_t n = 0; n < parts.size(); ++n)
    out += (n == 0 ? "" : n + 1 == parts.size() ? " and " : ", ") + parts[n];
  return out;
}

std::string orders(const StudyReport& report, std::size_t group) {
  std::vector<std::string> fitted, none;
  for (const StudyCurve& curve : report.curves) {
    if (curve.group != group) continue;
    if (curve.fit)
      fitted.push_back(fmt::format("{} {:.2f} (theory {})", curve.integrator, curve.fit->order, curve.theory));
    else
      none.push_back(curve.integrator);
  }
  std::string out;
  if (!fitted.empty()) out = "Observed orders: " + joined(fitted) + ".";
  if (!none.empty())
    out +=
        fmt::format("{}Of {} too few points lie on a line for an order.", out.empty() ? "" : " ", joined(none));
  return out;
}

std::string failures(const StudyReport& report, std::size_t group) {
  std::vector<std::string> parts;
  std::size_t below = 0;
  for (const StudyCurve& curve : report.curves) {
    if (curve.group != group) continue;
    std::size_t failed = 0;
    const StudyRow* finest = nullptr; // of the failed runs
    for (std::size_t n : curve.rows) {
      const StudyRow& row = report.rows[n];
      if (!row.failed()) continue;
      ++failed;
      finest = &row;
      below += !row.above_limit() && row.outcome != Outcome::Inaccurate;
    }
    if (failed == 0) continue;
    parts.push_back(fmt::format("{} {} of {} ({} and more)", curve.integrator, failed, curve.rows.size(),
                                finest->tolerance ? fmt::format("a tolerance of {:g}", *finest->tolerance)
                                                  : fmt::format("steps of {:.3g} s", finest->step)));
  }
  if (parts.empty()) return "No run failed.";
  return fmt::format("Runs that failed: {}; {} within what is predicted to be stable.", joined(parts),
                     below == 0 ? "none of them for steps" : fmt::format("{} of them for steps", below));
}

std::string trust(const StudyReport& report, std::size_t group) {
  const StudyReference& r = report.references[group];
  const std::string bar =
      fmt::format("The reference ({}, steps of {:.3g} s) and a second scheme ({}) differ by {:.2g}", r.scheme,
                  r.step, r.second, r.bar);
  if (r.good_enough())
    return bar + fmt::format(", less than a tenth of the smallest error here ({:.2g}).", r.smallest);
  std::size_t doubtful = 0;
  for (const StudyRow& row : report.rows) doubtful += row.group == group && row.doubtful;
  return bar +
         fmt::format(", which is NOT below a tenth of the smallest error here ({:.2g}): {} {} within ten times "
                     "the error bar, are drawn hollow, and count for no order.",
                     r.smallest, doubtful, doubtful == 1 ? "run lies" : "runs lie");
}

std::string tears_in_words(const StudyReport& report, std::size_t group) {
  const StudyReference& r = report.references[group];
  if (!r.first_tear) return report.tears ? "Nothing tears in this stretch." : "";
  return fmt::format(
      "It tears first at {:.6g} s (by the second scheme at {}), {} times in all; the reference's and the "
      "second scheme's torn edges overlap by {:.3g}. Errors of position count up to the first tear, after "
      "which trajectories part.",
      *r.first_tear, r.second_first_tear ? fmt::format("{:.6g} s", *r.second_first_tear) : "no time", r.tears,
      r.torn_overlap);
}

} // namespace

std::vector<std::string> findings_of(const StudyReport& report) {
  std::vector<std::string> all;
  for (std::size_t g = 0; g < report.groups.size(); ++g) {
    const std::string where = report.groups.size() > 1 ? report.groups[g].name + ": " : "";
    all.push_back(fmt::format("{}{} {}", where, cheapest(report, g, 1), cheapest(report, g, 2)));
    for (const std::string& more :
         {orders(report, g), failures(report, g), tears_in_words(report, g), trust(report, g)})
      if (!more.empty()) all.push_back(where + more);
    if (const auto& distance = report.references[g].distance)
      all.push_back(fmt::format("{}its exact motion is {:.3g} of the motion away from that of {}.", where,
                                *distance, report.groups.front().name));
  }
  return all;
}

} // namespace rend
