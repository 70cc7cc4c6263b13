#include "render/pages/study_page.h"

#include "render/report/page.h"

#include <fmt/format.h>

#include <cmath>

namespace rend {
namespace {

using namespace html;

TableCell text_cell(const std::string& text) {
  return {escaped(text)};
}
TableCell number_cell(double value, int digits = 3) {
  return {escaped(in_digits(value, digits)), fmt::format("{:.17g}", value)};
}
TableCell number_cell(const std::optional<double>& value, int digits = 3) {
  return value ? number_cell(*value, digits) : TableCell{muted("–"), "inf"};
}

std::string seconds_text(double seconds) {
  if (seconds < 1e-3) return fmt::format("{:.3g} µs", 1e6 * seconds);
  if (seconds < 1) return fmt::format("{:.3g} ms", 1e3 * seconds);
  return fmt::format("{:.3g} s", seconds);
}
TableCell seconds_cell(double seconds) {
  return {escaped(seconds_text(seconds)), fmt::format("{:.17g}", seconds)};
}

std::string group_name(const StudyReport& report, std::size_t group) {
  return report.groups.size() > 1 ? report.groups[group].name : "";
}

bool many(const StudyReport& report) {
  return report.groups.size() > 1;
}

// Prepends a cell with the group's name if there are several groups.
std::vector<TableCell> begin_row(const StudyReport& report, std::size_t group) {
  std::vector<TableCell> row;
  if (many(report)) row.push_back(text_cell(group_name(report, group)));
  return row;
}
std::vector<TableColumn> begin_columns(const StudyReport& report) {
  return many(report) ? std::vector<TableColumn>{{"group"}} : std::vector<TableColumn>{};
}

Html reach_table(const StudyReport& report) {
  Table table;
  table.columns = begin_columns(report);
  table.columns.push_back({"scheme"});
  for (double target : report.targets) table.columns.push_back(number_column(fmt::format("to {:.0e}", target)));
  for (const StudyCurve& curve : report.curves) {
    auto row = begin_row(report, curve.group);
    row.push_back({code(curve.integrator)});
    for (std::size_t n = 0; n < report.targets.size(); ++n) {
      const auto& reach = curve.reach[n];
      bool best = reach.has_value();
      for (const StudyCurve& other : report.curves)
        if (other.group == curve.group && reach && other.reach[n] && other.reach[n]->seconds < reach->seconds)
          best = false;
      if (!reach)
        row.push_back({muted("not reached"), "inf"});
      else {
        const std::string text = (reach->at_most ? "≤ " : "") + seconds_text(reach->seconds);
        row.push_back({best ? strong(text) : escaped(text), fmt::format("{:.17g}", reach->seconds)});
      }
    }
    table.rows.push_back(std::move(row));
  }
  table.sortable = true;
  return html::table(table) +
         paragraph(muted(
             "Between two runs of a scheme by a straight line in logarithms; ≤: already its coarsest run that "
             "holds is as exact."));
}

Html order_table(const StudyReport& report) {
  Table table;
  table.columns = begin_columns(report);
  for (TableColumn column : std::vector<TableColumn>{{"scheme"},
                                                     number_column("theory"),
                                                     number_column("observed"),
                                                     number_column("95 % interval"),
                                                     number_column("points"),
                                                     {"steps"},
                                                     {""}})
    table.columns.push_back(column);
  for (const StudyCurve& curve : report.curves) {
    auto row = begin_row(report, curve.group);
    row.push_back({code(curve.integrator)});
    row.push_back(number_cell(curve.theory));
    if (!curve.fit) {
      for (int n = 0; n < 4; ++n) row.push_back({muted("–")});
      row.push_back({badge(Tone::Plain, "too few points")});
      table.rows.push_back(std::move(row));
      continue;
    }
    const OrderFit& fit = *curve.fit;
    const StudyRow &fine = report.rows[fit.used.front()], &coarse = report.rows[fit.used.back()];
    row.push_back({strong(fmt::format("{:.3f}", fit.order))});
    row.push_back(text_cell(fmt::format("{:.3f} … {:.3f}", fit.low, fit.high)));
    row.push_back(text_cell(fmt::format("{} of {}", fit.used.size(), curve.rows.size())));
    row.push_back(text_cell(fmt::format("{:.3g} … {:.3g} s", fine.mean_step(), coarse.mean_step())));
    const bool near = std::abs(fit.order - curve.theory) <= 0.1;
    row.push_back({near ? badge(Tone::Good, "within 0.1 of theory") : badge(Tone::Limit, "not the theory's")});
    table.rows.push_back(std::move(row));
  }
  Html out = html::table(table);
  for (std::size_t g = 0; g < report.groups.size(); ++g)
    out += paragraph(muted((many(report) ? report.groups[g].name + ": " : "") + report.rules[g].words()));
  return out;
}

Html reference_table(const StudyReport& report) {
  Table table;
  table.columns = begin_columns(report);
  for (TableColumn column : std::vector<TableColumn>{{"reference"},
                                                     {"second scheme"},
                                                     number_column("error bar"),
                                                     number_column("smallest error"),
                                                     {""},
                                                     number_column("motion [m]"),
                                                     number_column("speed [m/s]"),
                                                     number_column("energy [J]"),
                                                     number_column("vertices"),
                                                     number_column("elements")})
    table.columns.push_back(column);
  for (std::size_t g = 0; g < report.groups.size(); ++g) {
    const StudyReference& r = report.references[g];
    auto row = begin_row(report, g);
    row.push_back(text_cell(fmt::format("{}, {:.3g} s", r.scheme, r.step)));
    row.push_back(text_cell(fmt::format("{}, {:.3g} s", r.second, r.second_step)));
    row.push_back(number_cell(r.bar, 2));
    row.push_back(number_cell(r.smallest, 2));
    row.push_back(
        {r.good_enough() ? badge(Tone::Good, "below a tenth") : badge(Tone::Limit, "not below a tenth")});
    for (double value : {r.scales.length, r.scales.speed, r.scales.energy})
      row.push_back(number_cell(value, 4));
    row.push_back(number_cell(static_cast<double>(r.vertices), 9));
    row.push_back(number_cell(static_cast<double>(r.elements), 9));
    table.rows.push_back(std::move(row));
  }
  return html::table(table);
}

std::string how_it_failed(const StudyRow& row) {
  if (row.outcome == Outcome::Refused) return row.reason;
  return row.steps_done < row.steps ? fmt::format("at step {}", row.steps_done) : row.reason;
}

Html row_table(const StudyReport& report) {
  Table table;
  table.columns = begin_columns(report);
  for (TableColumn column : std::vector<TableColumn>{{"scheme"},
                                                     number_column("step [s]"),
                                                     number_column("steps"),
                                                     number_column("error"),
                                                     number_column("final"),
                                                     number_column("largest [m]"),
                                                     number_column("velocity"),
                                                     number_column("energy"),
                                                     number_column("run time"),
                                                     number_column("fastest"),
                                                     number_column("slowest"),
                                                     number_column("runs"),
                                                     number_column("forces"),
                                                     number_column("Newton"),
                                                     number_column("CG"),
                                                     number_column("factors")})
    table.columns.push_back(column);
  if (report.isolated) table.columns.push_back(number_column("momentum [kg m/s]"));
  if (report.tears)
    for (const char* name : {"first tear [s]", "tears", "overlap"})
      table.columns.push_back(number_column(name));
  table.columns.push_back({""});
  table.sortable = true;
  for (const StudyRow& r : report.rows) {
    auto row = begin_row(report, r.group);
    row.push_back({code(r.tolerance ? fmt::format("{} {:.0e}", r.integrator, *r.tolerance) : r.integrator)});
    row.push_back(number_cell(r.mean_step()));
    row.push_back(number_cell(static_cast<double>(r.steps), 9));
    const bool done = !r.failed() && r.errors;
    const auto value = [&](double v, int digits = 3) {
      return done ? number_cell(v, digits) : TableCell{muted("–"), "inf"};
    };
    row.push_back(value(r.error));
    row.push_back(value(done ? r.errors->position.final / report.references[r.group].scales.length : 0));
    row.push_back(value(done ? r.errors->position.over_time_max : 0));
    row.push_back(value(r.velocity_error));
    row.push_back(value(r.energy_error));
    for (double seconds : {r.time.median, r.time.low, r.time.high}) row.push_back(seconds_cell(seconds));
    row.push_back(number_cell(r.time.runs));
    for (long count : {r.counts.evaluations, r.counts.newton, r.counts.cg, r.counts.factorisations})
      row.push_back(number_cell(static_cast<double>(count), 9));
    if (report.isolated) row.push_back(done ? number_cell(r.errors->momentum) : TableCell{muted("–"), "inf"});
    if (report.tears) {
      row.push_back(number_cell(r.first_tear, 6));
      row.push_back(number_cell(static_cast<double>(r.tears), 9));
      row.push_back(value(r.torn_overlap));
    }
    Html mark;
    if (r.failed()) mark += badge(Tone::Bad, name_of(r.outcome)) + escaped(" ") + muted(how_it_failed(r));
    if (r.on_front) mark += badge(Tone::Good, "front");
    if (r.doubtful) mark += badge(Tone::Limit, "within the reference's error");
    if (r.above_limit() && !r.failed()) mark += badge(Tone::Note, "above the limit");
    row.push_back({mark});
    table.rows.push_back(std::move(row));
  }
  return html::table(table);
}

Html answer_table(const StudyReport& report) {
  Table table;
  table.columns = begin_columns(report);
  for (TableColumn column :
       std::vector<TableColumn>{{"scheme"}, number_column("step [s]"), {"answer"}, number_column("error")})
    table.columns.push_back(column);
  table.sortable = true;
  for (const StudyRow& r : report.rows) {
    for (const AnswerError& answer : r.answers) {
      auto row = begin_row(report, r.group);
      row.push_back({code(r.integrator)});
      row.push_back(number_cell(r.step));
      row.push_back(text_cell(answer.name));
      row.push_back(number_cell(answer.error));
      table.rows.push_back(std::move(row));
    }
  }
  if (table.rows.empty()) return {};
  return heading(2, "Against the preset's own answers") +
         paragraph(
             escaped("Relative, where the answer is not 0; of runs of which a step ended at that time.")) +
         html::table(table);
}

Html how_it_was_measured(const StudyReport& report) {
  return list(
      {escaped(fmt::format("Stretch: {:.6g} s of a clip of {:.6g} s ({}), with {} samples after the start.",
                           report.duration, report.clip, report.why_duration, report.samples)),
       escaped(
           "Error: √(Σ m |Δx|² / Σ m) over all points, root mean square over the samples, divided by how far "
           "the reference moves from its start at most in the same norm. Velocities by the largest speed, "
           "energies by the largest kinetic energy."),
       escaped(
           "Run time: the time loop alone, without building and without samples, by the clock of its thread; "
           "one thread; median of the runs after one that is not counted (three where one takes over 1 s, one "
           "over 10 s).")});
}

} // namespace

std::string page_of(const StudyReport& report, const std::string& name, const std::vector<DrawnPlot>& plots,
                    const Provenance& p) {
  const std::vector<std::string> findings = findings_of(report);
  Html body = paragraph(strong(findings.front()));
  std::vector<Html> rest;
  for (std::size_t n = 1; n < findings.size(); ++n) rest.push_back(escaped(findings[n]));
  body += list(rest) + heading(2, "Plots");
  for (const DrawnPlot& plot : plots)
    if (!plot.svg.empty()) body += figure(PictureFormat::Svg, plot.svg, plot.caption, escaped(plot.caption));
  if (plots.empty() || plots.front().svg.empty())
    body += paragraph(badge(Tone::Limit, "no plots") +
                      escaped(" gnuplot is not installed (Debian: gnuplot-nox); the numbers are all here."));
  body += heading(2, "Time to reach an error") + reach_table(report);
  body += heading(2, "Orders") + order_table(report);
  body += heading(2, "The reference") + reference_table(report);
  body += answer_table(report);
  body += heading(2, "All runs") + row_table(report);
  body += heading(2, "How it was measured") + how_it_was_measured(report);
  body += heading(2, "Where it comes from") + facts_of(p);
  return page("Study of " + name, body);
}

} // namespace rend
