#include "sim/base/settings.h"

#include <array>
#include <charconv>

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

} // namespace rend
