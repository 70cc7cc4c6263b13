// PNG files composed chunk by chunk, including ones that no encoder would write.
#pragma once

#include "render/files/png_chunks.h"

#include <cstdint>
#include <string>

#ifdef REND_PNG
#include <libdeflate.h>
#endif

namespace rend::test {

#ifdef REND_PNG
inline std::uint32_t crc_of(const std::string& bytes) {
  return libdeflate_crc32(0, bytes.data(), bytes.size());
}
inline std::string deflated(const std::string& rows) {
  libdeflate_compressor* compressor = libdeflate_alloc_compressor(9);
  std::string out(libdeflate_zlib_compress_bound(compressor, rows.size()), '\0');
  out.resize(libdeflate_zlib_compress(compressor, rows.data(), rows.size(), out.data(), out.size()));
  libdeflate_free_compressor(compressor);
  return out;
}
#else // tests that need it skip themselves
inline std::uint32_t crc_of(const std::string&) {
  return 0;
}
inline std::string deflated(const std::string&) {
  return "";
}
#endif

inline std::string png_number(std::uint32_t number) {
  std::string out;
  for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(number >> shift);
  return out;
}

inline std::string png_chunk(const std::string& name, const std::string& data) {
  return png_number(static_cast<std::uint32_t>(data.size())) + name + data + png_number(crc_of(name + data));
}

// Colour types: 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGB and alpha.
inline PngHeader header_of(std::uint32_t width, std::uint32_t height, int bits = 8, int colour = 2,
                           bool interlaced = false) {
  return {width, height, bits, colour, 0, 0, interlaced ? 1 : 0};
}

// Signature and IHDR; the given chunks; IEND.
inline std::string png_file(const PngHeader& header, const std::string& chunks) {
  std::string head = png_number(header.width) + png_number(header.height);
  for (const int byte : {header.bits, header.colour, header.deflated, header.filtered, header.interlaced})
    head += static_cast<char>(byte);
  return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", head) + chunks + png_chunk("IEND", "");
}

// A valid file, all black (or transparent); a palette has only that colour.
inline std::string black_png(const PngHeader& header) {
  const std::string palette = header.colour == 3 ? png_chunk("PLTE", std::string(3, '\0')) : "";
  return png_file(header, palette + png_chunk("IDAT", deflated(std::string(png_rows_bytes(header), '\0'))));
}

} // namespace rend::test
