// PNG: written with libdeflate, read by libpng.
//
// Deflate level 1 behind the SUB filter: 8 ms and 263 KB for a picture of 1280 x 720, where libpng's level 1
// takes 13 ms and 312 KB, its defaults 84 ms. No time stamp is written, and no text but what the caller gives:
// equal pictures are equal files.
//
// Source: Portable Network Graphics (PNG) Specification (Second Edition), W3C, 2003.
#pragma once

#include "render/files/image.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

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

// What encode_png() makes of an image of that size: 8 bits a channel, 3 channels or 4, not interlaced.
struct PngShape {
  int width = 0, height = 0; // [pixels]
  int channels = 3;
};

// Finds out which files are pictures of one shape that need not be made again. It reads the whole file and
// inflates it: 1 ms for a picture of 1280 x 720. For one thread; what it works in is kept from file to file.
class PngChecker {
public:
  explicit PngChecker(const PngShape& shape);
  ~PngChecker();
  PngChecker(const PngChecker&) = delete;
  PngChecker& operator=(const PngChecker&) = delete;

  // An ordinary file (or a link to one) that is a whole PNG: every chunk's CRC is right and IEND the last, the
  // header says this shape, the data inflate to exactly its rows, and the text under the keyword is that one.
  // False of all else, without waiting for whom a FIFO would want.
  bool is_whole(const std::filesystem::path& path, const PngText& text);

  static std::size_t bytes(const PngShape& shape); // of its rows, which is about what it works in

private:
  struct Work;
  bool has_whole_chunks(const PngText& text);
  bool has_whole_rows();

  PngShape shape_;
  std::unique_ptr<Work> work_;
};

// Any PNG, brought to 8-bit RGB, or RGBA if it has transparency. Throws UserError: NoInput, ReadWrite,
// BadInput; OutOfBudget where there is no memory for it.
Image read_png(const std::filesystem::path& path);

} // namespace rend
