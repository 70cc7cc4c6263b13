#include "render/pages/named_values.h"

#include "sim/base/printable.h"

#include <nlohmann/json.hpp>

namespace rend {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const NamedValue::Value& value) {
  return std::visit(
      [](const auto& v) -> Json {
        if constexpr (std::is_same_v<decltype(v), const std::monostate&>)
          return nullptr;
        else
          return v;
      },
      value);
}

// Quotes are doubled.
std::string text_in_csv(const std::string& any, CsvStyle style) {
  const std::string text = printable(any);
  if (style == CsvStyle::Plain && text.find_first_of(",\"") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string in_csv(const NamedValue::Value& value, CsvStyle style) {
  if (std::holds_alternative<std::monostate>(value)) return {};
  if (const auto* text = std::get_if<std::string>(&value)) return text_in_csv(*text, style);
  const bool* const flag = std::get_if<bool>(&value);
  return flag && style == CsvStyle::Plain ? (*flag ? "1" : "0") : json_of(value).dump();
}

template <class Text> std::string line_of(const NamedValues& row, const Text& text) {
  std::string line;
  for (const NamedValue& one : row) line += (&one == &row.front() ? "" : ",") + text(one);
  return line + "\r\n";
}

} // namespace

Json json_of(const NamedValues& row) {
  Json json = Json::object();
  for (const NamedValue& one : row) json[one.name] = json_of(one.value);
  return json;
}

std::string csv_of(const std::vector<NamedValues>& rows, CsvStyle style) {
  std::string out;
  for (const NamedValues& row : rows) {
    if (out.empty())
      out = line_of(row, [](const NamedValue& one) { return text_in_csv(one.name, CsvStyle::Plain); });
    out += line_of(row, [&](const NamedValue& one) { return in_csv(one.value, style); });
  }
  return out;
}

} // namespace rend
