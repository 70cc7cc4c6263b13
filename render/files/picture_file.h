// Pictures from files of any format that rend reads, which the first bytes tell and not the name: PNG (png.h)
// and JPEG (jpeg.h). Values are taken as sRGB: colour profiles and gamma in a file are ignored.
//
// Files that are longer than most_picture_bytes are refused before they are read: 4096 x 4096 pixels of 8 bits
// and 4 channels that nothing compresses are 67 MB.
#pragma once

#include "render/files/image.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace rend {

constexpr std::size_t most_picture_bytes = 80'000'000;

// "a PNG", "a JPEG", "a GIF" ..., by the first 12 bytes of a file; empty if unknown.
std::string picture_kind(std::span<const std::uint8_t> first);

// What is known of a picture before it is decoded.
struct PictureInfo {
  int width = 0, height = 0; // [pixels]; 0 where the header of a PNG is damaged
};

// Both throw UserError, at the path. NoInput, ReadWrite; BadInput: it is no picture, is damaged or too long;
// Usage: rend was built without its format; OutOfBudget: there is not enough memory.
PictureInfo picture_info(const std::filesystem::path& path);
Image read_picture(const std::filesystem::path& path); // upright, RGB, or RGBA if it has transparency

} // namespace rend
