#include "render/pages/batch_table.h"

#include "sim/base/printable.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <map>
#include <string_view>
#include <system_error>

namespace rend {
namespace {

using Json = nlohmann::ordered_json;

// Whether it is numbers, separated by blanks: no spreadsheet takes one for a formula.
bool is_numbers(std::string_view text) {
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    double number = 0;
    const char* begin = word.data() + (word.starts_with('+') ? 1 : 0); // from_chars takes no plus
    const auto [end, error] = std::from_chars(begin, word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size()) return false;
    text.remove_prefix(std::min(word.size() + 1, text.size()));
  }
  return true;
}

// Spreadsheets run a text that begins so as a formula.
bool is_like_a_formula(std::string_view text) {
  return !text.empty() && std::string_view("=+-@").find(text.front()) != std::string_view::npos &&
         !is_numbers(text);
}

// Columns in the order in which they first appear, and the values of each line.
class Columns {
public:
  void begin_line() { lines_.emplace_back(); }
  void put(const std::string& column, const std::string& value) {
    if (std::find(names_.begin(), names_.end(), column) == names_.end()) names_.push_back(column);
    lines_.back()[column] = value;
  }
  std::string text() const {
    std::string out;
    for (const std::string& name : names_) out += (out.empty() ? "" : ",") + quoted(name);
    out += '\n';
    for (const auto& line : lines_) {
      std::string row;
      for (std::size_t n = 0; n < names_.size(); ++n) {
        const auto value = line.find(names_[n]);
        row += (n == 0 ? "" : ",") + (value == line.end() ? "" : quoted(value->second));
      }
      out += row + '\n';
    }
    return out;
  }

private:
  static std::string quoted(const std::string& raw) {
    const std::string text = (is_like_a_formula(raw) ? "'" : "") + printable(raw);
    if (text.find_first_of(",\"") == std::string::npos) return text;
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + '"';
  }

  std::vector<std::string> names_;
  std::vector<std::map<std::string, std::string>> lines_;
};

void put_all(const Json& json, const std::string& path, Columns& columns) {
  if (json.is_structured()) {
    for (const auto& [name, value] : json.items())
      put_all(value, path.empty() ? name : path + "." + name, columns);
  } else if (json.is_string()) {
    columns.put(path, json.get<std::string>());
  } else {
    columns.put(path, json.is_null() ? "" : json.dump());
  }
}

} // namespace

std::string batch_csv(const BatchReport& report) {
  Columns columns;
  for (std::size_t n = 0; n < report.jobs.size(); ++n) {
    const BatchJob& job = report.jobs[n];
    const BatchResult& result = report.results[n];
    columns.begin_line();
    columns.put("job", job.name);
    columns.put("preset", job.preset);
    columns.put("state", name_of(result.state()));
    columns.put("code", std::to_string(result.code));
    columns.put("message", result.message);
    columns.put("seconds", fmt::format("{:.3f}", result.seconds));
    columns.put("peak_bytes", std::to_string(result.peak));
    for (const std::string& set : job.sets)
      columns.put(set.substr(0, set.find('=')), set.substr(set.find('=') + 1));
    Json figures = Json::parse(result.printed, nullptr, false);
    if (figures.is_discarded()) continue;
    figures.erase("preset");
    put_all(figures, "", columns);
  }
  return columns.text();
}

} // namespace rend
