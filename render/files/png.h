// PNG: written with libdeflate, read by libpng.
//
// Deflate level 1 after the SUB filter: 8 ms and 263 KB for a picture of 1280 x 720, where libpng's level 1
// takes 13 ms and 312 KB, its defaults 84 ms. No time stamp is written, and no text but the caller's: equal
// pictures give equal files.
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

// False if rend was built without REND_PNG; the functions below then throw UserError (Usage), and require_png()
// does nothing else.
bool png_available();
void require_png();

// A tEXt chunk: a keyword of at most 79 characters and a text, both Latin-1. An empty keyword: no chunk.
struct PngText {
  std::string keyword, text;
};

// The bytes of a PNG file. The same picture and text give the same bytes.
std::vector<std::uint8_t> encode_png(const Image& image, const PngText& text = {});

// Atomic, as OutputFile. Throws UserError: CannotCreate where the file cannot be created, ReadWrite where
// writing fails.
void write_png(const std::filesystem::path& path, const Image& image, const PngText& text = {});

// The format of what encode_png() makes of an image of that size: 8 bits a channel, 3 or 4 channels, not
// interlaced.
struct PngShape {
  int width = 0, height = 0; // [pixels]
  int channels = 3;
};

// Tests which files are complete pictures of one shape, which need not be made again. It reads and inflates the
// whole file: 1 ms for a picture of 1280 x 720. To be used by one thread; its buffers are reused from file to
// file.
class PngChecker {
public:
  explicit PngChecker(const PngShape& shape);
  ~PngChecker();
  PngChecker(const PngChecker&) = delete;
  PngChecker& operator=(const PngChecker&) = delete;

  // True for a regular file (or a link to one) that is a complete PNG: the CRC of every chunk is right and IEND
  // is the last, the header has this shape, the data inflate to exactly its rows, and the text of the keyword
  // is the given one. False for everything else; does not block on a FIFO.
  bool is_whole(const std::filesystem::path& path, const PngText& text);

  static std::size_t bytes(const PngShape& shape); // of its rows: about the size of the buffers

private:
  struct Work;
  bool has_whole_chunks(const PngText& text);
  bool has_whole_rows();

  PngShape shape_;
  std::unique_ptr<Work> work_;
};

// Reads any PNG, converted to 8-bit RGB, or RGBA if it has transparency. Throws UserError: NoInput, ReadWrite,
// BadInput; OutOfBudget if there is not enough memory.
Image read_png(const std::filesystem::path& path);

} // namespace rend
