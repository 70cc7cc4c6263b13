// A row of a table of figures: named values, in one list for JSON and CSV.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace rend {

struct NamedValue {
  using Value =
      std::variant<std::monostate, bool, long, std::size_t, double, std::string>; // monostate: not there

  template <class T>
  NamedValue(std::string its_name, const T& its_value)
      : name(std::move(its_name)), value(value_of(its_value)) {}

  std::string name;
  Value value;

private:
  static Value value_of(bool v) { return v; }
  static Value value_of(int v) { return static_cast<long>(v); }
  static Value value_of(long v) { return v; }
  static Value value_of(std::size_t v) { return v; }
  static Value value_of(double v) { return v; }
  static Value value_of(const char* v) { return std::string(v); }
  static Value value_of(const std::string& v) { return v; }
  static Value value_of(std::monostate) { return {}; }
  template <class T> static Value value_of(const std::optional<T>& v) { return v ? value_of(*v) : Value{}; }
};
using NamedValues = std::vector<NamedValue>;

// An object. What is not there is null, and so is a number that is not finite.
nlohmann::ordered_json json_of(const NamedValues& row);

// CSV (RFC 4180), whose numbers have the digits of JSON and whose missing values are empty.
enum class CsvStyle {
  Plain, // quotes where a text needs them; 1 and 0
  Quoted // quotes around each text; true and false
};
// The lines of a table, the names first. All rows have the same names.
std::string csv_of(const std::vector<NamedValues>& rows, CsvStyle style);

} // namespace rend
