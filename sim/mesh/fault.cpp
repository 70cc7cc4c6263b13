#include "sim/mesh/fault.h"

#include <fmt/format.h>

#include <cmath>

namespace rend {

MeshFault::MeshFault(const std::string& kind, std::size_t number, const std::string& what_is_wrong)
    : std::invalid_argument(fmt::format("{} {}: {}", kind, number, what_is_wrong)), element(number),
      flaw(what_is_wrong) {}

namespace {

std::string flaw_of_extent(const char* what, const char* unit, double extent, double length) {
  if (extent == 0) return fmt::format("has no {}", what);
  if (!std::isfinite(extent) || !std::isfinite(length))
    return fmt::format("has too large a length or {} for a number of 64 bits", what);
  return fmt::format("is too long and thin to compute with: {:.3g} {} at a length of {:.3g} m",
                     std::abs(extent), unit, length);
}

} // namespace

std::string flaw_of_volume(double volume, double length) {
  return flaw_of_extent("volume", "m3", volume, length);
}

std::string flaw_of_area(double area, double length) {
  return flaw_of_extent("area", "m2", area, length);
}

} // namespace rend
