// PNG in with the depth that it has, for who compares pictures: what 8 bits cannot tell apart stays apart.
// read_png() (png.h) is the same reader, brought to 8 bits.
//
// Any PNG is read: 1 to 16 bits, grey, colour, palette, transparent colours, alpha, interlaced. It becomes RGB
// or RGBA of 8 bits a channel (16 where the file has 16); grey becomes three equal channels, fewer bits are
// spread over the whole range (PNG specification, 13.12). Values are taken as sRGB: profiles and gammas in the
// file change nothing.
#pragma once

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

// More pixels are refused: a file of a few bytes can claim any number.
constexpr long max_png_pixels = 1L << 28;

// `bytes`: a whole file. Throws UserError (BadInput, at `name`) where it is no PNG, cut off or damaged: what is
// wrong is said, and what other kind of file it is where that can be told.
DeepImage read_deep_png(std::span<const std::uint8_t> bytes, const std::string& name);

// A file's bytes. Throws UserError: NoInput where it cannot be opened, or is no ordinary file; ReadWrite.
std::vector<std::uint8_t> file_bytes(const std::filesystem::path& path);

} // namespace rend
