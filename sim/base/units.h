// Quantities in words, with the prefixes of the SI: 12300 Pa is "12.3 kPa".
#pragma once

#include <string>

namespace rend {

// Three digits; the number alone where there is no unit. Minus signs are typographic.
std::string in_units(double value, const std::string& unit);

} // namespace rend
