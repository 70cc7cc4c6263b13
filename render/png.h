// PNG: written with libdeflate, read by libpng.
//
// Deflate level 1 behind the SUB filter: 8 ms and 263 KB for a picture of 1280 x 720, where libpng's level 1
// takes 13 ms and 312 KB, its defaults 84 ms. No time stamp is written, and no text but what the caller gives:
// equal pictures are equal files.
//
// Source: Portable Network Graphics (PNG) Specification (Second Edition), W3C, 2003.
#pragma once

#include "render/image.h"

#include <filesystem>
#include <optional>
#include <string>

namespace rend {

// False where rend was built without REND_PNG; all that follows then throws UserError (Usage), and
// require_png() does nothing else.
bool png_available();
void require_png();

// A tEXt chunk: a keyword of at most 79 characters and a text, both Latin-1. Without a keyword there is none.
struct PngText {
  std::string keyword, text;
};

// The bytes of a PNG file. The same picture and text give the same bytes.
std::vector<std::uint8_t> encode_png(const Image& image, const PngText& text = {});

// Whole or not at all. Throws UserError: CannotCreate where the file cannot be made, ReadWrite where writing
// fails.
void write_png(const std::filesystem::path& path, const Image& image, const PngText& text = {});

// Of a file that is a whole PNG (every chunk's CRC is right, and the last is IEND), the text under a keyword:
// "" where it has none. None: there is no such file, or it is not whole. Nothing is decoded: a millisecond for
// a megabyte.
std::optional<std::string> text_of_whole_png(const std::filesystem::path& path, const std::string& keyword);

// Any PNG, brought to 8-bit RGB, or RGBA if it has transparency. Throws UserError: NoInput, ReadWrite,
// BadInput.
Image read_png(const std::filesystem::path& path);

} // namespace rend
