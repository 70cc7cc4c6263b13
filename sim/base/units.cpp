#include "sim/base/units.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>

namespace rend {
namespace {

struct Prefix {
  double factor;
  const char* name;
};
constexpr std::array<Prefix, 9> prefixes{{{1e12, "T"},
                                          {1e9, "G"},
                                          {1e6, "M"},
                                          {1e3, "k"},
                                          {1, ""},
                                          {1e-3, "m"},
                                          {1e-6, "µ"},
                                          {1e-9, "n"},
                                          {1e-12, "p"}}};

} // namespace

std::string in_units(double value, const std::string& unit) {
  const std::string sign = value < 0 ? "−" : "";
  double size = std::abs(value);
  if (unit.empty()) return sign + fmt::format("{:.3g}", size);
  if (size == 0) return "0 " + unit;
  // rounding 999.9 to three digits may need the next prefix
  size = std::strtod(fmt::format("{:.2e}", size).c_str(), nullptr);
  for (const Prefix& prefix : prefixes)
    if (size >= prefix.factor)
      return sign + fmt::format("{:.3g} {}{}", size / prefix.factor, prefix.name, unit);
  return sign + fmt::format("{:.3g} {}", size, unit);
}

} // namespace rend
