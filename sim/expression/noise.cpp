#include "sim/expression/noise.h"

#include "sim/base/hash.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace rend {
namespace {

// In [0, 1): 53 bits of the hash. Whole numbers are hashed as doubles, since a position may be of any size.
double at_corner(double i, double j, double k, double seed) {
  const std::array<double, 4> key{i + 0.0, j + 0.0, k + 0.0, seed + 0.0}; // −0 + 0 is 0
  return static_cast<double>(hash_bytes(key.data(), sizeof key) >> 11) * 0x1p-53;
}

double between(double a, double b, double weight) {
  return a + weight * (b - a);
}

} // namespace

double noise(const std::array<double, 3>& position, double seed) {
  std::array<double, 3> low{}, high{}, weight{};
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = std::floor(position[axis]);
    high[axis] = low[axis] + 1;
    const double t = position[axis] - low[axis];
    weight[axis] = t * t * (3 - 2 * t);
  }
  const auto along_x = [&](double y, double z) {
    return between(at_corner(low[0], y, z, seed), at_corner(high[0], y, z, seed), weight[0]);
  };
  const auto over_face = [&](double z) { return between(along_x(low[1], z), along_x(high[1], z), weight[1]); };
  // Rounding may reach 1.
  return std::clamp(between(over_face(low[2]), over_face(high[2]), weight[2]), 0.0, 1 - 0x1p-53);
}

} // namespace rend
