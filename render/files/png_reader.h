// Reads PNG files at their full bit depth, for comparing pictures. read_png() (png.h) is the same reader with
// conversion to 8 bits.
//
// Any PNG is read: 1 to 16 bits, grey, colour, palette, transparent colours, alpha, interlaced. The result is
// RGB or RGBA with 8 bits a channel (16 if the file has 16); grey becomes three equal channels, fewer bits are
// scaled to the whole range (PNG specification, 13.12). Values are taken as sRGB: colour profiles and gamma in
// the file are ignored.
//
// The header of a small file can state any number of pixels. More than max_png_pixels are refused, and so are
// more than its compressed data can hold; otherwise memory grows as rows are read (for an interlaced picture,
// it is allocated at once). A small valid file can still decode to gigabytes: for untrusted files, call
// png_info() first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace rend {

struct HighDepthImage {
  int width = 0, height = 0;          // [pixels]
  int channels = 3;                   // 3: RGB, 4: RGBA
  int bits = 8;                       // 8 or 16
  std::vector<std::uint16_t> samples; // height x width x channels, row 0 is the top; 0 to 255, or to 65535
  std::string kind;                   // format in the file: "RGB, 8 bits", "palette, 4 bits, interlaced"
};

constexpr long max_png_pixels = 1L << 28;

// What is known of a PNG before it is decoded.
struct PngInfo {
  int width = 0, height = 0;  // [pixels]; 0 where the header is damaged
  int bits = 8;               // as in HighDepthImage
  std::size_t file_bytes = 0; // of the whole file
  std::size_t rows_bytes = 0; // inflated, by the header

  bool is_plausible() const; // whether a file of this length can hold so many pixels
  // upper bound of the memory of file_bytes() and read_high_depth_png() together
  std::size_t decoding_bytes() const;
  std::size_t checking_bytes() const; // the same for check_png()
  bool operator==(const PngInfo&) const = default;
};

// From the first bytes of a file, or from a whole file in memory. Throws as the two functions below do, for
// what can be detected this early.
PngInfo png_info(const std::filesystem::path& path);
PngInfo png_info(std::span<const std::uint8_t> bytes, const std::string& name);

// `bytes`: a whole file. Throws UserError (BadInput, at `name`) if it is not a PNG, truncated or damaged: the
// message says what is wrong, and for other known file types which; OutOfBudget if there is not enough memory.
HighDepthImage read_high_depth_png(std::span<const std::uint8_t> bytes, const std::string& name);

// Validates without keeping pixels: throws what read_high_depth_png() would. Holds a row at a time.
void check_png(std::span<const std::uint8_t> bytes, const std::string& name);

} // namespace rend
