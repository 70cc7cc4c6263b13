#include "render/pages/study_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

// A scheme has the same style in all plots of all studies.
int look_of(const std::string& integrator) {
  const auto& all = all_schemes();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Scheme& scheme) { return scheme.name == integrator; });
  return static_cast<int>(found - all.begin());
}

// The options of a plot's axes.
struct Axes {
  double (*x)(const StudyRow&);
  std::optional<double> (*y)(const StudyReport&, const StudyRow&);
  bool log_y = true;
  bool spread = false; // error bars for the run times, along x
  bool doubts = false; // marks errors that may be those of the reference
};

double seconds(const StudyRow& row) {
  return row.time.median;
}
double mean_step(const StudyRow& row) {
  return row.mean_step();
}
std::optional<double> error(const StudyReport&, const StudyRow& row) {
  return row.error;
}
std::optional<double> total_error(const StudyReport&, const StudyRow& row) {
  return row.total_error;
}
std::optional<double> energy(const StudyReport&, const StudyRow& row) {
  return row.energy_error;
}
std::optional<double> tear_time(const StudyReport& report, const StudyRow& row) {
  const auto& reference = report.references[row.group].first_tear;
  if (!row.first_tear || !reference) return {};
  return std::abs(*row.first_tear - *reference) / *reference;
}
std::optional<double> torn_overlap(const StudyReport&, const StudyRow& row) {
  return row.torn_overlap;
}

PlotSeries series_of(const StudyReport& report, const StudyCurve& curve, const Axes& axes) {
  PlotSeries series;
  series.name = curve.integrator;
  series.style_number = look_of(curve.integrator);
  for (std::size_t n : curve.rows) {
    const StudyRow& row = report.rows[n];
    const double x = axes.x(row);
    if (!(x > 0)) continue;
    if (row.failed() && row.outcome != Outcome::Refused) series.out.push_back(x);
    if (row.failed()) continue;
    const auto y = axes.y(report, row);
    if (!y || !std::isfinite(*y) || (axes.log_y && *y <= 0)) continue;
    PlotPoint point{.x = x, .y = *y, .hollow = axes.doubts && row.doubtful};
    if (axes.spread) {
      point.left = std::max(row.time.low, 1e-12);
      point.right = row.time.high;
    }
    series.points.push_back(point);
  }
  return series;
}

Plot plot_of(const StudyReport& report, std::size_t group, const Axes& axes) {
  Plot plot;
  plot.log_x = true;
  plot.log_y = axes.log_y;
  plot.out_name = "failed";
  plot.hollow_name = "within the reference's error";
  for (const StudyCurve& curve : report.curves)
    if (curve.group == group) plot.series.push_back(series_of(report, curve, axes));
  for (PlotSeries& series : plot.series)
    if (series.points.empty() && series.out.empty()) series.name.clear(); // not in the legend
  return plot;
}

PlotSeries front_of(const StudyReport& report, std::size_t group) {
  PlotSeries front{.name = "Pareto front", .style = PlotSeries::Style::Back};
  for (const StudyRow& row : report.rows)
    if (row.group == group && row.on_front && row.error > 0)
      front.points.push_back({.x = row.time.median, .y = row.error});
  std::sort(front.points.begin(), front.points.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  return front;
}

void name_orders(const StudyReport& report, std::size_t group, Plot& plot) {
  std::size_t n = 0;
  for (const StudyCurve& curve : report.curves) {
    if (curve.group != group) continue;
    if (curve.fit)
      plot.series[n].name +=
          fmt::format("  {:.2f} ± {:.2f}", curve.fit->order, curve.fit->high - curve.fit->order);
    ++n;
  }
}

constexpr const char* error_label = "error of position / motion";

void add_error_bar(const StudyReport& report, std::size_t group, Plot& plot) {
  const double bar = report.references[group].bar;
  if (bar > 0 && std::isfinite(bar)) plot.levels.push_back({bar, "error bar of the reference"});
}

NamedPlot work_precision(const StudyReport& report, std::size_t group) {
  Plot plot = plot_of(report, group, {.x = seconds, .y = error, .spread = true, .doubts = true});
  plot.x_label = "run time [s]";
  plot.y_label = error_label;
  plot.series.insert(plot.series.begin(), front_of(report, group));
  add_error_bar(report, group, plot);
  return {"work-precision",
          "Error against run time: the further down and to the left, the better. Bars span the fastest and the "
          "slowest "
          "of the timed runs. The broad grey line joins the runs that no other beats.",
          plot};
}

NamedPlot error_of_step(const StudyReport& report, std::size_t group) {
  Plot plot = plot_of(report, group, {.x = mean_step, .y = error, .doubts = true});
  plot.x_label = "step [s]";
  plot.y_label = error_label;
  name_orders(report, group, plot);
  add_error_bar(report, group, plot);
  return {"order",
          "Error against step; of an adaptive scheme, its mean step. The legend has the fitted order of each "
          "with the "
          "half of its 95 % interval.",
          plot};
}

NamedPlot energy_of_step(const StudyReport& report, std::size_t group) {
  Plot plot = plot_of(report, group, {.x = mean_step, .y = energy});
  plot.x_label = "step [s]";
  plot.y_label = "drift of energy / largest kinetic energy";
  return {"energy",
          "The largest drift of the energy during the run, against the reference's, which knows of what is "
          "dissipated "
          "and driven.",
          plot};
}

std::vector<NamedPlot> tearing(const StudyReport& report, std::size_t group) {
  Plot time = plot_of(report, group, {.x = mean_step, .y = tear_time});
  time.x_label = "step [s]";
  time.y_label = "|time of first tear - reference's| / reference's";
  Plot torn = plot_of(report, group, {.x = mean_step, .y = torn_overlap, .log_y = false});
  torn.x_label = "step [s]";
  torn.y_label = "overlap of what is torn (Jaccard)";
  return {{"tear-time",
           "When it tears first, against the reference. A law looks at the start of each step, so that a "
           "step's length is "
           "what can be expected; what is exact stands on no logarithmic axis.",
           time},
          {"tear-overlap",
           "How much of what is torn at the end is what the reference has torn: 1 is the same set of edges (of "
           "a solid: "
           "faces).",
           torn}};
}

NamedPlot all_groups(const StudyReport& report) {
  Plot plot;
  plot.log_x = plot.log_y = true;
  plot.x_label = "run time [s]";
  plot.y_label = fmt::format("distance from {} / motion", report.groups.front().name);
  for (const StudyCurve& curve : report.curves) {
    PlotSeries series = series_of(report, curve, {.x = seconds, .y = total_error});
    series.name = curve.integrator + ", " + report.groups[curve.group].name;
    series.style_number = static_cast<int>(plot.series.size());
    series.out.clear();
    if (!series.points.empty()) plot.series.push_back(series);
  }
  return {"groups",
          "All groups against the reference of the first: the error of the scheme and what mesh or model do, "
          "together.",
          plot};
}

} // namespace

std::vector<NamedPlot> plots_of(const StudyReport& report, const std::string& name) {
  std::vector<NamedPlot> all;
  for (std::size_t g = 0; g < report.groups.size(); ++g) {
    std::vector<NamedPlot> here{work_precision(report, g), error_of_step(report, g), energy_of_step(report, g)};
    if (report.references[g].first_tear)
      for (NamedPlot& plot : tearing(report, g)) here.push_back(std::move(plot));
    for (NamedPlot& plot : here) {
      if (report.groups.size() > 1) plot.file += fmt::format("-{}", g + 1);
      plot.plot.title = name + (report.groups.size() > 1 ? ", " + report.groups[g].name : "");
      all.push_back(std::move(plot));
    }
  }
  if (report.groups.size() > 1) {
    all.push_back(all_groups(report));
    all.back().plot.title = name;
  }
  return all;
}

} // namespace rend
