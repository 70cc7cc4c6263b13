// Splits a PNG file into its chunks. Nothing is inflated, and sizes that the file states are checked against
// its actual length.
//
// A signature, then chunks of length, name, data and CRC-32; the first is the header IHDR, the IDAT chunks
// together hold the rows as one zlib stream, the last is IEND. Source: PNG specification, 5.2, 5.3, 11.2.
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
  std::uint32_t crc = 0; // as stored in the file
};

// Removes the first chunk from `rest`. None: the rest is too short for it.
std::optional<PngChunk> take_png_chunk(PngBytes& rest);

// The fields of IHDR.
struct PngHeader {
  std::uint32_t width = 0, height = 0; // [pixels]
  int bits = 0;                        // per sample: 1, 2, 4, 8, 16
  int colour = 0;                      // 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGB and alpha
  int deflated = 0, filtered = 0, interlaced = 0;

  bool operator==(const PngHeader&) const = default;
};

// Size of a file up to the end of IHDR. Below: none if a file is shorter, or begins with another chunk.
constexpr std::size_t png_header_bytes = png_signature_bytes + 25;
std::optional<PngHeader> png_header(PngBytes file);

// [bytes] that the zlib stream must inflate to, including the filter type of each row. At most 2^31 pixels
// (CHECK).
std::size_t png_rows_bytes(const PngHeader& header);

// The zlib stream, as far as it is in the file.
struct PngData {
  std::size_t bytes = 0; // total length of the IDAT chunks
  bool cut_off = false;  // the file ends before IEND
};
PngData png_data(PngBytes file);

// Deflate makes at most 258 bytes from 2 bits, the shortest code of a match and its distance (RFC 1951, 3.2.5).
constexpr std::size_t most_inflated = 258 * 4; // output bytes per input byte

} // namespace rend
