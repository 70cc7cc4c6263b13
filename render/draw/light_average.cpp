#include "render/draw/light_average.h"

#include "sim/base/check.h"
#include "sim/base/math.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace rend {
namespace {

constexpr std::size_t piece_size = 128; // [bytes]: 32 pixels
constexpr double white = 65535;

// 0 to 1, of an sRGB number of 0 to 1.
double light_of(double number) {
  return number <= 0.04045 ? number / 12.92 : power((number + 0.055) / 1.055, 2.4);
}

struct Tables {
  Tables() {
    for (std::size_t n = 0; n < lights.size(); ++n)
      lights[n] = static_cast<std::uint16_t>(white * light_of(static_cast<double>(n) / 255) + 0.5);
    std::size_t level = 0; // the boundary between two levels is half a level above the lower one
    for (std::size_t light = 0; light < levels.size(); ++light) {
      while (level < 255 &&
             static_cast<double>(light) >= white * light_of((static_cast<double>(level) + 0.5) / 255))
        ++level;
      levels[light] = static_cast<std::uint8_t>(level);
    }
  }
  std::array<std::uint16_t, 256> lights;
  std::array<std::uint8_t, 65536> levels;
};

const Tables& tables() {
  static const Tables all;
  return all;
}

} // namespace

std::uint16_t light_of_level(std::uint8_t level) {
  return tables().lights[level];
}

std::uint8_t level_of_light(std::uint16_t light) {
  return tables().levels[light];
}

void LightAverage::start(std::size_t bytes, bool opaque) {
  CHECK(bytes % 4 == 0);
  opaque_ = opaque;
  weight_ = 0;
  first_.resize(bytes);
  sums_.resize(bytes);
  differs_.assign((bytes + piece_size - 1) / piece_size, 0);
}

void LightAverage::add(std::span<const std::uint8_t> picture, int weight) {
  CHECK(picture.size() == first_.size() && weight > 0 && weight_ + static_cast<std::uint32_t>(weight) <= 256);
  const auto counts = static_cast<std::uint32_t>(weight);
  if (weight_ == 0) std::copy(picture.begin(), picture.end(), first_.begin());
  for (std::size_t n = 0; n < differs_.size() && weight_ > 0; ++n) {
    const std::size_t at = n * piece_size, size = std::min(piece_size, first_.size() - at);
    const auto piece = picture.subspan(at, size);
    if (differs_[n] == 0) {
      if (std::memcmp(piece.data(), first_.data() + at, size) == 0) continue;
      differs_[n] = 1;
      std::fill_n(sums_.begin() + static_cast<std::ptrdiff_t>(at), size, 0U);
      add_piece(std::span(first_).subspan(at, size), at, weight_); // it was the same until now
    }
    add_piece(piece, at, counts);
  }
  weight_ += counts;
}

// A sum is at most 65535 x 255 x 256, which is below 2^32.
void LightAverage::add_piece(std::span<const std::uint8_t> piece, std::size_t at, std::uint32_t weight) {
  const auto& lights = tables().lights;
  std::uint32_t* sum = sums_.data() + at;
  for (std::size_t n = 0; n < piece.size(); n += 4) {
    const std::uint32_t alpha = opaque_ ? 255 : piece[n + 3];
    for (std::size_t c = 0; c < 3 && alpha > 0; ++c) {
      const std::uint32_t level =
          alpha == 255 ? piece[n + c] : std::min(255U, (piece[n + c] * 255U + alpha / 2) / alpha);
      sum[n + c] += weight * alpha * lights[level];
    }
    sum[n + 3] += weight * alpha;
  }
}

void LightAverage::mean_of_piece(std::span<std::uint8_t> piece, std::size_t at) const {
  const auto& levels = tables().levels;
  const std::uint32_t* sum = sums_.data() + at;
  for (std::size_t n = 0; n < piece.size(); n += 4) {
    const std::uint32_t covered = sum[n + 3], alpha = (covered + weight_ / 2) / weight_;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint64_t light = covered == 0 ? 0 : (std::uint64_t{sum[n + c]} + covered / 2) / covered;
      piece[n + c] = static_cast<std::uint8_t>((levels[light] * alpha + 127) / 255);
    }
    piece[n + 3] = static_cast<std::uint8_t>(alpha);
  }
}

void LightAverage::mean(std::span<std::uint8_t> picture) const {
  CHECK(picture.size() == first_.size() && weight_ > 0);
  std::copy(first_.begin(), first_.end(), picture.begin());
  for (std::size_t n = 0; n < differs_.size(); ++n)
    if (differs_[n] != 0)
      mean_of_piece(picture.subspan(n * piece_size, std::min(piece_size, first_.size() - n * piece_size)),
                    n * piece_size);
}

} // namespace rend
