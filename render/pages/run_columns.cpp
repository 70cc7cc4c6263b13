#include "render/pages/run_columns.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <functional>

namespace rend {
namespace {

using Json = nlohmann::ordered_json;
using namespace html;

// A number, or a word that is read as it stands; null: unknown.
struct Figure {
  const char* name;
  Json (*of)(const Json& figures);
};

Json first_tear(const Json& figures) {
  Json first;
  for (const Json& law : figures.at("laws"))
    if (law.at("first").is_number() && (first.is_null() || law.at("first") < first)) first = law.at("first");
  return first;
}

// "2 of 3"
Json answers_that_hold(const Json& figures) {
  const Json& all = figures.at("answers");
  if (all.empty()) return nullptr;
  const auto holds =
      std::count_if(all.begin(), all.end(), [](const Json& one) { return one.at("holds") == true; });
  return fmt::format("{} of {}", holds, all.size());
}

const std::vector<Figure>& shown_figures() {
  static const std::vector<Figure> all{
      {"steps", [](const Json& f) { return f.at("steps"); }},
      {"time [s]", [](const Json& f) { return f.at("time"); }},
      {"tears", [](const Json& f) { return f.at("tears"); }},
      {"first tear [s]", &first_tear},
      {"fragments", [](const Json& f) { return f.at("fragments"); }},
      {"largest, of the mass", [](const Json& f) { return f.at("fragment_sizes").at("largest"); }},
      {"kinetic [J]", [](const Json& f) { return f.at("energy").at("kinetic"); }},
      {"elastic [J]", [](const Json& f) { return f.at("energy").at("elastic"); }},
      {"answers hold", &answers_that_hold}};
  return all;
}

// Paths that any job sets, in the order in which they first appear.
std::vector<std::string> swept_paths(const BatchReport& report) {
  std::vector<std::string> paths;
  for (const BatchJob& job : report.jobs)
    for (const std::string& set : job.sets)
      if (const std::string path = set.substr(0, set.find('='));
          std::find(paths.begin(), paths.end(), path) == paths.end())
        paths.push_back(path);
  return paths;
}

TableCell cell_of(const Json& value) {
  if (value.is_number_integer()) return {escaped(value.dump()), value.dump()};
  if (value.is_number()) return {escaped(in_digits(value.get<double>(), 4)), value.dump()};
  return {escaped(value.is_string() ? value.get<std::string>() : "–")};
}

Json value_of(const Figure& figure, const Json& figures) {
  try {
    return figures.is_object() ? figure.of(figures) : Json(nullptr);
  } catch (const nlohmann::json::exception&) {
    return nullptr; // another program printed it
  }
}

} // namespace

std::vector<TableColumn> run_columns(const BatchReport& report) {
  std::vector<TableColumn> columns;
  for (const std::string& path : swept_paths(report)) columns.push_back(number_column(path));
  for (const Figure& figure : shown_figures()) columns.push_back(number_column(figure.name));
  return columns;
}

std::vector<TableCell> run_cells(const BatchReport& report, std::size_t job) {
  std::vector<TableCell> cells;
  for (const std::string& path : swept_paths(report)) {
    const std::vector<std::string>& sets = report.jobs[job].sets;
    const auto set = std::find_if(sets.begin(), sets.end(),
                                  [&](const std::string& one) { return one.starts_with(path + "="); });
    cells.push_back({escaped(set == sets.end() ? "–" : set->substr(path.size() + 1))});
  }
  const Json figures = Json::parse(report.results[job].printed, nullptr, false);
  for (const Figure& figure : shown_figures()) cells.push_back(cell_of(value_of(figure, figures)));
  return cells;
}

} // namespace rend
