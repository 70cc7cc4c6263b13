// A PNG file as the chunks that it is made of: nothing is inflated, and no claim of a file is believed that its
// own bytes contradict.
//
// A signature, then chunks of length, name, data and CRC-32; the first is the header IHDR, those called IDAT
// hold the rows in one zlib stream, the last is IEND. Source: PNG specification, 5.2, 5.3, 11.2.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace rend {

using PngBytes = std::span<const std::uint8_t>;

constexpr std::size_t png_signature_bytes = 8;
bool has_png_signature(PngBytes file);

struct PngChunk {
  std::string_view name; // of four characters
  PngBytes data;
  std::uint32_t crc = 0; // as it stands there
};

// Takes the first chunk off `rest`. None: what is left is too short for it.
std::optional<PngChunk> take_png_chunk(PngBytes& rest);

// What IHDR says.
struct PngHeader {
  std::uint32_t width = 0, height = 0; // [pixels]
  int bits = 0;                        // of a sample: 1, 2, 4, 8, 16
  int colour = 0;                      // 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGB and alpha
  int deflated = 0, filtered = 0, interlaced = 0;

  bool operator==(const PngHeader&) const = default;
};

// Bytes of a file up to the end of IHDR. Where a file begins with fewer, or with another chunk, there is none.
constexpr std::size_t png_header_bytes = png_signature_bytes + 25;
std::optional<PngHeader> png_header(PngBytes file);

// [bytes] of the rows that the zlib stream must hold, each with the number of its filter. At most 2^31 pixels
// (CHECK).
std::size_t png_rows_bytes(const PngHeader& header);

// The zlib stream, as far as it is there.
struct PngData {
  std::size_t bytes = 0; // in all chunks called IDAT
  bool cut_off = false;  // the file ends before IEND
};
PngData png_data(PngBytes file);

// Deflate makes at most 258 bytes of 2 bits, the least that a match and its distance take (RFC 1951, 3.2.5).
constexpr std::size_t most_inflated = 258 * 4; // bytes of each byte

} // namespace rend
