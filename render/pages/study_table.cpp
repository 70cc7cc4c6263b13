#include "render/pages/study_table.h"

#include "sim/base/printable.h"

#include <fmt/format.h>

#include <cmath>
#include <set>

namespace rend {
namespace {

using Json = nlohmann::ordered_json;

// JSON knows no infinity.
Json json_number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

template <class T> Json json_or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

// The names of CSV's columns are those of these objects: one list for both.
Json row_json(const StudyReport& report, const StudyRow& row) {
  const bool done = !row.failed() && row.errors;
  const auto error = [&](double value) { return done ? Json(value) : Json(nullptr); };
  const StateErrors none, &e = row.errors ? *row.errors : none;
  return {{"group", report.groups[row.group].name},
          {"integrator", row.integrator},
          {"step", row.step},
          {"tolerance", json_or_null(row.tolerance)},
          {"steps", row.steps},
          {"steps_done", row.steps_done},
          {"limit", json_number(row.limit)},
          {"above_limit", row.above_limit()},
          {"outcome", name_of(row.outcome)},
          {"error", error(row.error)},
          {"velocity_error", error(row.velocity_error)},
          {"energy_error", error(row.energy_error)},
          {"total_error", json_or_null(row.total_error)},
          {"position_l2", error(e.position.over_time)},
          {"position_l2_final", error(e.position.final)},
          {"position_max", error(e.position.over_time_max)},
          {"position_max_final", error(e.position.final_max)},
          {"velocity_l2", error(e.velocity.over_time)},
          {"velocity_l2_final", error(e.velocity.final)},
          {"velocity_max", error(e.velocity.over_time_max)},
          {"velocity_max_final", error(e.velocity.final_max)},
          {"energy_drift", error(e.energy)},
          {"momentum_drift", done ? json_or_null(e.momentum) : Json(nullptr)},
          {"angular_momentum_drift", done ? json_or_null(e.angular) : Json(nullptr)},
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
          {"parts", row.counts.parts},
          {"rejected", row.counts.rejected},
          {"tears", row.tears},
          {"first_tear", json_or_null(row.first_tear)},
          {"torn_overlap", row.torn_overlap}};
}

std::string csv_field(const Json& value) {
  if (value.is_null()) return {};
  if (!value.is_string()) return value.is_boolean() ? (value.get<bool>() ? "1" : "0") : value.dump();
  const std::string text = printable(value.get<std::string>());
  if (text.find_first_of(",\"") == std::string::npos) return text;
  std::string out = "\"";
  for (char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
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

Json answers_json(const StudyRow& row) {
  Json answers = Json::object();
  for (const AnswerError& answer : row.answers) answers[answer.name] = json_number(answer.error);
  return answers;
}

Json reference_json(const StudyReport& report, std::size_t group) {
  const StudyReference& r = report.references[group];
  return {{"group", report.groups[group].name},
          {"scheme", r.scheme},
          {"step", r.step},
          {"second_scheme", r.second},
          {"second_step", r.second_step},
          {"error_bar", json_number(r.bar)},
          {"smallest_error", json_number(r.smallest)},
          {"good_enough", r.good_enough()},
          {"length", r.scales.length},
          {"speed", r.scales.speed},
          {"energy", r.scales.energy},
          {"mass", r.scales.mass},
          {"vertices", r.vertices},
          {"elements", r.elements},
          {"tears", r.tears},
          {"first_tear", json_or_null(r.first_tear)},
          {"second_first_tear", json_or_null(r.second_first_tear)},
          {"torn_overlap", r.torn_overlap},
          {"distance", json_or_null(r.distance)}};
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
  std::string out;
  for (const StudyRow& row : report.rows) {
    const Json fields = row_json(report, row);
    if (out.empty()) {
      for (const auto& [name, value] : fields.items()) out += name + ",";
      for (const std::string& name : answers) out += csv_field("answer " + name) + ",";
      out += "reason\r\n";
    }
    for (const auto& [name, value] : fields.items()) out += csv_field(value) + ",";
    for (const std::string& name : answers) {
      for (const AnswerError& answer : row.answers)
        if (answer.name == name) out += csv_field(json_number(answer.error));
      out += ",";
    }
    out += csv_field(row.reason) + "\r\n";
  }
  return out;
}

Json json_of(const StudyReport& report) {
  Json json{{"duration", report.duration}, {"clip", report.clip},   {"why_duration", report.why_duration},
            {"samples", report.samples},   {"tears", report.tears}, {"isolated", report.isolated}};
  for (std::size_t g = 0; g < report.groups.size(); ++g) {
    json["references"].push_back(reference_json(report, g));
    json["rules"].push_back(report.rules[g].words());
  }
  for (const StudyCurve& curve : report.curves) json["curves"].push_back(curve_json(report, curve));
  for (const StudyRow& row : report.rows) {
    Json one = row_json(report, row);
    one["answers"] = answers_json(row);
    one["reason"] = row.reason;
    json["rows"].push_back(std::move(one));
  }
  return json;
}

} // namespace rend
