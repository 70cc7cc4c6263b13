#include "render/console/number_option.h"

#include "sim/base/wording.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <string>
#include <string_view>

namespace rend {
namespace {

template <class T> std::optional<T> number_in(std::string_view text) {
  // from_chars accepts no plus sign
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

// Rewrites the text in a form that can be read in one way only.
template <class T> WordCheck number_between(T low, T high, const char* kind, const char* what) {
  const auto read = [=](std::string& text) -> std::string {
    const std::optional<T> value = number_in<T>(text);
    if (!value || !(*value >= low && *value <= high)) // also refuses nan
      return fmt::format("{} is not a {} from {} to {}", in_quotes(text), what, low, high);
    text = fmt::format("{}", *value);
    return {};
  };
  return {read, fmt::format("{} in [{} - {}]", kind, low, high)};
}

} // namespace

WordCheck whole_number(long low, long high) {
  return number_between(low, high, "INT", "whole number");
}

WordCheck real_number(double low, double high) {
  return number_between(low, high, "FLOAT", "number");
}

WordCheck some_word() {
  return {[](std::string& text) { return std::string(text.empty() ? "the value is empty" : ""); }, ""};
}

} // namespace rend
