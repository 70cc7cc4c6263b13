#include "render/compare/heat.h"

#include "sim/base/check.h"

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

using Rgb = std::array<float, 3>;

// The colour map magma at multiples of 1/8, by S. van der Walt and N. Smith (CC0); linear interpolation between
// them is within 6 levels of it.
constexpr std::array<Rgb, 9> magma{{{0, 0, 4},
                                    {28, 16, 68},
                                    {79, 18, 123},
                                    {129, 37, 129},
                                    {181, 54, 122},
                                    {229, 80, 100},
                                    {251, 135, 97},
                                    {254, 194, 135},
                                    {252, 253, 191}}};

} // namespace

Image heat_of(const Levels& map, int width, int height, const PixelMask& mask) {
  Image image(width, height);
  CHECK(map.size() * 3 == image.pixels.size());
  for (std::size_t n = 0; n < map.size(); ++n) {
    const float at = std::clamp(map[n], 0.f, 1.f) * (magma.size() - 1);
    const std::size_t low = std::min(static_cast<std::size_t>(at), magma.size() - 2);
    const float part = at - static_cast<float>(low);
    for (std::size_t c = 0; c < 3; ++c) {
      const float value = magma[low][c] + part * (magma[low + 1][c] - magma[low][c]);
      image.pixels[3 * n + c] = mask[n] ? static_cast<std::uint8_t>(std::lround(value)) : std::uint8_t{128};
    }
  }
  return image;
}

} // namespace rend
