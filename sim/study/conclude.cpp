// The conclusions from the rows of a study: marks, Pareto fronts, orders, times to reach an error.
#include "sim/study/study.h"

#include <algorithm>
#include <limits>

namespace rend {
namespace {

// an error of at least so many error bars of the reference is attributed to the run
constexpr double trust = 10;

void mark(StudyReport& report, std::size_t group) {
  StudyReference& reference = report.references[group];
  reference.smallest = std::numeric_limits<double>::infinity();
  std::vector<std::size_t> done;
  std::vector<WorkPrecision> work;
  for (std::size_t n = 0; n < report.rows.size(); ++n) {
    StudyRow& row = report.rows[n];
    if (row.group != group || row.failed()) continue;
    row.doubtful = row.error <= trust * reference.bar;
    reference.smallest = std::min(reference.smallest, row.error);
    done.push_back(n);
    work.push_back({row.time.median, row.error});
  }
  for (std::size_t n : pareto_front(work)) report.rows[done[n]].on_front = true;
}

StudyCurve curve_of(const StudyReport& report, std::size_t group, const std::string& integrator) {
  StudyCurve curve;
  curve.group = group;
  curve.integrator = integrator;
  curve.theory = find_scheme(integrator)->order;
  std::vector<OrderPoint> points;
  std::vector<WorkPrecision> work;
  for (std::size_t n = 0; n < report.rows.size(); ++n) {
    const StudyRow& row = report.rows[n];
    if (row.group != group || row.integrator != integrator) continue;
    curve.rows.push_back(n);
    points.push_back({row.mean_step(), row.error, row.failed()});
    if (!row.failed()) work.push_back({row.time.median, row.error});
  }
  curve.fit = fit_order(points, report.rules[group]);
  if (curve.fit)
    for (std::size_t& used : curve.fit->used) used = curve.rows[used];
  for (double target : report.targets) curve.reach.push_back(time_to_reach(work, target));
  return curve;
}

} // namespace

void conclude(StudyReport& report) {
  report.rules.clear();
  report.curves.clear();
  for (std::size_t g = 0; g < report.groups.size(); ++g) {
    mark(report, g);
    OrderRule rule;
    rule.smallest = trust * report.references[g].bar;
    report.rules.push_back(rule);
    std::vector<std::string> seen;
    for (const StudyRow& row : report.rows)
      if (row.group == g && std::find(seen.begin(), seen.end(), row.integrator) == seen.end())
        seen.push_back(row.integrator);
    for (const std::string& integrator : seen) report.curves.push_back(curve_of(report, g, integrator));
  }
}

} // namespace rend
