// Quantities as text, with SI prefixes: 12300 Pa is "12.3 kPa".
#pragma once

#include <string>

namespace rend {

// Three significant digits; without a unit, the number alone. Minus signs are U+2212.
std::string in_units(double value, const std::string& unit);

} // namespace rend
