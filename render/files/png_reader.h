// PNG in with the depth that it has, for who compares pictures: what 8 bits cannot tell apart stays apart.
// read_png() (png.h) is the same reader, brought to 8 bits.
//
// Any PNG is read: 1 to 16 bits, grey, colour, palette, transparent colours, alpha, interlaced. It becomes RGB
// or RGBA of 8 bits a channel (16 where the file has 16); grey becomes three equal channels, fewer bits are
// spread over the whole range (PNG specification, 13.12). Values are taken as sRGB: profiles and gammas in the
// file change nothing.
//
// A file of a few bytes can claim any number of pixels. More than max_png_pixels are refused, and so are those
// that its compressed data cannot hold; of the rest memory is taken as rows come (of an interlaced picture at
// once). Of a small file these can still be gigabytes: who reads what others made asks png_head() first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace rend {

struct DeepImage {
  int width = 0, height = 0;          // [pixels]
  int channels = 3;                   // 3: RGB, 4: RGBA
  int bits = 8;                       // 8 or 16
  std::vector<std::uint16_t> samples; // height x width x channels, row 0 is the top; 0 to 255, or to 65535
  std::string kind;                   // what stood in the file: "RGB, 8 bits", "palette, 4 bits, interlaced"
};

constexpr long max_png_pixels = 1L << 28;

// What can be told of a PNG before it is read.
struct PngHead {
  int width = 0, height = 0;  // [pixels]; 0 where the header is damaged
  int bits = 8;               // as of DeepImage
  std::size_t file_bytes = 0; // of the whole file
  std::size_t rows_bytes = 0; // that are deflated in it, as the header says

  bool can_be_true() const;           // such a file may hold so much
  std::size_t decoding_bytes() const; // at most, that file_bytes() and read_deep_png() take together
  std::size_t checking_bytes() const; // the same of check_png()
  bool operator==(const PngHead&) const = default;
};

// Of the first bytes of a file, or of a whole one in memory. Throws as the two below do, of what can be told
// from there.
PngHead png_head(const std::filesystem::path& path);
PngHead png_head(std::span<const std::uint8_t> bytes, const std::string& name);

// `bytes`: a whole file. Throws UserError (BadInput, at `name`) where it is no PNG, cut off or damaged: what is
// wrong is said, and what other kind of file it is where that can be told; OutOfBudget where there is no memory
// for it.
DeepImage read_deep_png(std::span<const std::uint8_t> bytes, const std::string& name);

// Only whether it can be read: throws what that would. It holds no more than a row.
void check_png(std::span<const std::uint8_t> bytes, const std::string& name);

// A file's bytes. Throws UserError: NoInput where it cannot be opened, or is no ordinary file; ReadWrite.
std::vector<std::uint8_t> file_bytes(const std::filesystem::path& path);

} // namespace rend
