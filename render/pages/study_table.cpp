#include "render/pages/study_table.h"

#include "render/pages/named_values.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace rend {
namespace {

using Json = nlohmann::ordered_json;

// JSON knows no infinity.
std::optional<double> if_finite(double value) {
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

NamedValues values_of(const StudyReport& report, const StudyRow& row) {
  const bool done = !row.failed() && row.errors;
  const auto error = [&](std::optional<double> value) { return done ? value : std::nullopt; };
  const StateErrors none, &e = row.errors ? *row.errors : none;
  return {{"group", report.groups[row.group].name},
          {"integrator", row.integrator},
          {"step", row.step},
          {"tolerance", row.tolerance},
          {"steps", row.steps},
          {"steps_done", row.steps_done},
          {"limit", if_finite(row.limit)},
          {"above_limit", row.above_limit()},
          {"outcome", name_of(row.outcome)},
          {"error", error(row.error)},
          {"velocity_error", error(row.velocity_error)},
          {"energy_error", error(row.energy_error)},
          {"total_error", row.total_error},
          {"position_l2", error(e.position.over_time)},
          {"position_l2_final", error(e.position.final)},
          {"position_max", error(e.position.over_time_max)},
          {"position_max_final", error(e.position.final_max)},
          {"velocity_l2", error(e.velocity.over_time)},
          {"velocity_l2_final", error(e.velocity.final)},
          {"velocity_max", error(e.velocity.over_time_max)},
          {"velocity_max_final", error(e.velocity.final_max)},
          {"energy_drift", error(e.energy)},
          {"momentum_drift", error(e.momentum)},
          {"angular_momentum_drift", error(e.angular)},
          {"samples", e.samples},
          {"doubtful", row.doubtful},
          {"pareto", row.on_front},
          {"seconds", row.time.median},
          {"seconds_min", row.time.low},
          {"seconds_max", row.time.high},
          {"seconds_iqr", row.time.quartiles},
          {"runs", row.time.runs},
          {"evaluations", row.counts.evaluations},
          {"newton", row.counts.newton},
          {"cg", row.counts.cg},
          {"factorisations", row.counts.factorisations},
          {"parts", row.counts.substeps},
          {"rejected", row.counts.rejected},
          {"tears", row.tears},
          {"first_tear", row.first_tear},
          {"torn_overlap", row.torn_overlap}};
}

// Of all rows, in the order in which they come.
std::vector<std::string> answer_names(const StudyReport& report) {
  std::vector<std::string> names;
  std::set<std::string> seen;
  for (const StudyRow& row : report.rows)
    for (const AnswerError& answer : row.answers)
      if (seen.insert(answer.name).second) names.push_back(answer.name);
  return names;
}

NamedValues answers_of(const StudyRow& row) {
  NamedValues answers;
  for (const AnswerError& answer : row.answers) answers.emplace_back(answer.name, if_finite(answer.error));
  return answers;
}

NamedValues values_of(const StudyReport& report, std::size_t group) {
  const StudyReference& r = report.references[group];
  return {{"group", report.groups[group].name},
          {"scheme", r.scheme},
          {"step", r.step},
          {"second_scheme", r.second},
          {"second_step", r.second_step},
          {"error_bar", if_finite(r.bar)},
          {"smallest_error", if_finite(r.smallest)},
          {"good_enough", r.good_enough()},
          {"length", r.scales.length},
          {"speed", r.scales.speed},
          {"energy", r.scales.energy},
          {"mass", r.scales.mass},
          {"vertices", r.vertices},
          {"elements", r.elements},
          {"tears", r.tears},
          {"first_tear", r.first_tear},
          {"second_first_tear", r.second_first_tear},
          {"torn_overlap", r.torn_overlap},
          {"distance", r.distance}};
}

Json curve_json(const StudyReport& report, const StudyCurve& curve) {
  Json fit = nullptr, reach = Json::array();
  if (curve.fit)
    fit = {{"order", curve.fit->order},
           {"low", curve.fit->low},
           {"high", curve.fit->high},
           {"rows", curve.fit->used}};
  for (std::size_t n = 0; n < report.targets.size(); ++n)
    reach.push_back({{"error", report.targets[n]},
                     {"seconds", curve.reach[n] ? Json(curve.reach[n]->seconds) : Json(nullptr)},
                     {"at_most", curve.reach[n] && curve.reach[n]->at_most}});
  return {{"group", report.groups[curve.group].name},
          {"integrator", curve.integrator},
          {"theory", curve.theory},
          {"fit", fit},
          {"reach", reach}};
}

} // namespace

std::string csv_of(const StudyReport& report) {
  const std::vector<std::string> answers = answer_names(report);
  std::vector<NamedValues> all;
  for (const StudyRow& row : report.rows) {
    all.push_back(values_of(report, row));
    for (const std::string& name : answers) {
      const auto answer = std::find_if(row.answers.begin(), row.answers.end(),
                                       [&](const AnswerError& one) { return one.name == name; });
      all.back().emplace_back("answer " + name,
                              answer == row.answers.end() ? std::nullopt : if_finite(answer->error));
    }
    all.back().emplace_back("reason", row.reason);
  }
  return csv_of(all, CsvStyle::Plain);
}

Json json_of(const StudyReport& report) {
  Json json{{"duration", report.duration}, {"clip", report.clip},   {"why_duration", report.why_duration},
            {"samples", report.samples},   {"tears", report.tears}, {"isolated", report.isolated}};
  for (std::size_t g = 0; g < report.groups.size(); ++g) {
    json["references"].push_back(json_of(values_of(report, g)));
    json["rules"].push_back(report.rules[g].words());
  }
  for (const StudyCurve& curve : report.curves) json["curves"].push_back(curve_json(report, curve));
  for (const StudyRow& row : report.rows) {
    Json one = json_of(values_of(report, row));
    one["answers"] = json_of(answers_of(row));
    one["reason"] = row.reason;
    json["rows"].push_back(std::move(one));
  }
  return json;
}

} // namespace rend
