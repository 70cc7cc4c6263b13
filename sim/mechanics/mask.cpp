#include "sim/mechanics/mask.h"

#include "sim/base/check.h"

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

// Of a row of pixels, the two around a place and the share of the second.
struct Between {
  std::size_t first, second;
  double share;
};

Between between(double place, int count) { // place: from 0 to count, where pixel n has its middle at n + 1/2
  const double from_middle = std::clamp(place - 0.5, 0.0, static_cast<double>(count - 1));
  const double first = std::floor(from_middle);
  const auto n = static_cast<std::size_t>(first);
  return {n, std::min(n + 1, static_cast<std::size_t>(count - 1)), from_middle - first};
}

} // namespace

double Mask::at(const TexturePlace& place) const {
  CHECK(width > 0 && height > 0);
  const Between x = between(place.u * width, width), y = between((1 - place.v) * height, height);
  const auto row = [&](std::size_t n) {
    const float* const pixels = brightness.data() + n * static_cast<std::size_t>(width);
    return (1 - x.share) * pixels[x.first] + x.share * pixels[x.second];
  };
  return (1 - y.share) * row(y.first) + y.share * row(y.second);
}

} // namespace rend
