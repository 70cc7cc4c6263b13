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

// The cube around a position.
struct Cube {
  std::array<double, 3> low{}, high{}, weight{}, slope{}; // s(t), s'(t)

  explicit Cube(const std::array<double, 3>& position) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::floor(position[axis]);
      high[axis] = low[axis] + 1;
      const double t = position[axis] - low[axis];
      weight[axis] = t * t * (3 - 2 * t);
      slope[axis] = 6 * t * (1 - t);
    }
  }
};

} // namespace

std::array<double, 3> noise_gradient(const std::array<double, 3>& position, double seed) {
  const Cube cube(position);
  std::array<double, 3> gradient{};
  for (unsigned corner = 0; corner < 8; ++corner) {
    const auto upper = [&](unsigned axis) { return (corner >> axis & 1U) != 0; };
    const auto place = [&](unsigned axis) { return upper(axis) ? cube.high[axis] : cube.low[axis]; };
    const double height = at_corner(place(0), place(1), place(2), seed);
    for (unsigned along = 0; along < 3; ++along) {
      double share = height;
      for (unsigned axis = 0; axis < 3; ++axis) {
        const double of_upper = axis == along ? cube.slope[axis] : cube.weight[axis];
        share *= upper(axis) ? of_upper : (axis == along ? 0 : 1) - of_upper;
      }
      gradient[along] += share;
    }
  }
  return gradient;
}

double noise(const std::array<double, 3>& position, double seed) {
  const Cube cube(position);
  const auto &low = cube.low, &high = cube.high, &weight = cube.weight;
  const auto along_x = [&](double y, double z) {
    return between(at_corner(low[0], y, z, seed), at_corner(high[0], y, z, seed), weight[0]);
  };
  const auto over_face = [&](double z) { return between(along_x(low[1], z), along_x(high[1], z), weight[1]); };
  // Rounding may reach 1.
  return std::clamp(between(over_face(low[2]), over_face(high[2]), weight[2]), 0.0, 1 - 0x1p-53);
}

} // namespace rend
