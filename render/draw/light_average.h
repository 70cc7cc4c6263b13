// The mean of several pictures, as a film adds them up while the shutter is open: of light, not of the numbers
// in the pictures.
//
// The numbers are sRGB (IEC 61966-2-1), and light is roughly their 2.4th power. Levels become whole numbers of
// light, of which 65535 is white; these are added up, and the mean becomes the nearest level again. It is done
// with whole numbers and two tables, so that it gives the same bits on every machine. Where all pictures are
// the same, so is their mean, to the last level: lights of neighbouring levels differ by at least 19.
//
// What moves covers a small part of most pictures: only pieces of the pictures that differ from the first one
// are added up.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rend {

std::uint16_t light_of_level(std::uint8_t level);
std::uint8_t level_of_light(std::uint16_t light); // the level nearest in sRGB

class LightAverage {
public:
  // For pictures of so many bytes: red, green, blue, alpha of each pixel, the colours multiplied by alpha.
  // opaque: alpha means nothing.
  void start(std::size_t bytes, bool opaque);
  // CHECK: of that size. weight: above 0; of all pictures at most 256.
  void add(std::span<const std::uint8_t> picture, int weight);
  // CHECK: of that size, and there was a picture.
  void mean(std::span<std::uint8_t> picture) const;

private:
  void add_piece(std::span<const std::uint8_t> piece, std::size_t at, std::uint32_t weight);
  void mean_of_piece(std::span<std::uint8_t> piece, std::size_t at) const;

  bool opaque_ = true;
  std::uint32_t weight_ = 0;          // of all pictures so far
  std::vector<std::uint8_t> first_;   // the first picture
  std::vector<std::uint8_t> differs_; // one a piece: it is not the same in all pictures so far
  std::vector<std::uint32_t> sums_; // light times alpha times weight, and alpha times weight; unset where equal
};

} // namespace rend
