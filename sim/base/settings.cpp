#include "sim/base/settings.h"

#include "sim/base/wording.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace rend {

void SettingsSource::fail(std::string_view attribute, const std::string& what, const std::string& hint) const {
  throw UserError(Exit::BadInput, place(attribute), what, hint);
}

// to_chars pads exponents to two digits: 1e-06.
std::string fields::text_of(double value) {
  std::array<char, 32> room{};
  const auto [end, error] = std::to_chars(room.data(), room.data() + room.size(), value);
  CHECK(error == std::errc());
  std::string text(room.data(), end);
  const std::size_t exponent = text.find('e');
  if (exponent != std::string::npos && exponent + 2 < text.size() && text[exponent + 2] == '0')
    text.erase(exponent + 2, 1);
  return text;
}

std::string fields::text_of_list(std::span<const double> values) {
  std::string out;
  for (const double value : values) out += (out.empty() ? "" : " ") + text_of(value);
  return out;
}

void fields::check_numbers(const AttributeType& type, std::span<const double> values,
                           const SettingsSource& source) {
  for (const double value : values)
    if (!std::isfinite(value) || value < type.low || value > type.high || (type.open_low && value == type.low))
      source.fail(type.name, fmt::format("{} is {}; expected {}", type.name, value, expected(type)));
}

void fields::check_text(const AttributeType& type, const std::string& value, const SettingsSource& source) {
  if (value.empty() && type.required && !source.given(type.name)) refuse_missing(type, source);
  const bool listed_alone =
      type.kind == AttributeKind::Word || (type.kind == AttributeKind::Words && !type.names);
  if (value.empty() || !listed_alone) return;
  if (std::find(type.words.begin(), type.words.end(), value) == type.words.end())
    source.fail(type.name, fmt::format("{} is {}; expected {}", type.name, in_quotes(value), expected(type)),
                suggestion(value, type.words));
}

void fields::refuse_missing(const AttributeType& type, const SettingsSource& source) {
  source.fail(type.name, fmt::format("{} is missing; expected {}", type.name, expected(type)));
}

} // namespace rend
