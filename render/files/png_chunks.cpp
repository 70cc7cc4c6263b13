#include "render/files/png_chunks.h"

#include "sim/base/check.h"

#include <algorithm>
#include <array>

namespace rend {
namespace {

constexpr std::array<std::uint8_t, png_signature_bytes> signature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

std::uint32_t number_at(PngBytes bytes) { // big-endian
  return static_cast<std::uint32_t>(bytes[0]) << 24 | static_cast<std::uint32_t>(bytes[1]) << 16 |
         static_cast<std::uint32_t>(bytes[2]) << 8 | bytes[3];
}

std::size_t channels_of(int colour) {
  switch (colour) {
  case 2:
    return 3;
  case 4:
    return 2;
  case 6:
    return 4;
  default:
    return 1;
  }
}

// For a whole picture, or one pass of an interlaced one.
std::size_t rows_bytes(std::size_t width, std::size_t height, std::size_t pixel_bits) {
  return width == 0 ? 0 : height * (1 + (width * pixel_bits + 7) / 8);
}

} // namespace

bool has_png_signature(PngBytes file) {
  return file.size() >= signature.size() && std::equal(signature.begin(), signature.end(), file.begin());
}

std::optional<PngChunk> take_png_chunk(PngBytes& rest) {
  constexpr std::size_t around = 12; // bytes of length, name and CRC
  if (rest.size() < around) return {};
  const std::size_t length = number_at(rest);
  if (rest.size() - around < length) return {};
  const PngChunk chunk{{reinterpret_cast<const char*>(rest.data()) + 4, 4},
                       rest.subspan(8, length),
                       number_at(rest.subspan(8 + length))};
  rest = rest.subspan(around + length);
  return chunk;
}

std::optional<PngHeader> png_header(PngBytes file) {
  if (!has_png_signature(file)) return {};
  PngBytes rest = file.subspan(png_signature_bytes);
  const auto chunk = take_png_chunk(rest);
  if (!chunk || chunk->name != "IHDR" || chunk->data.size() != 13) return {};
  const PngBytes data = chunk->data;
  return PngHeader{number_at(data), number_at(data.subspan(4)), data[8], data[9], data[10], data[11], data[12]};
}

std::size_t png_rows_bytes(const PngHeader& header) {
  const std::size_t width = header.width, height = header.height;
  CHECK(width < (std::size_t{1} << 31) && height < (std::size_t{1} << 31) &&
        width * height <= std::size_t{1} << 31);
  const std::size_t bits = channels_of(header.colour) * static_cast<std::size_t>(header.bits);
  if (header.interlaced == 0) return rows_bytes(width, height, bits);
  struct Pass { // every step-th pixel (Adam7; PNG specification, 8.2)
    std::size_t x, y, step_x, step_y;
  };
  constexpr Pass passes[] = {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4},
                             {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}};
  std::size_t sum = 0;
  for (const Pass& pass : passes) {
    const auto count = [](std::size_t all, std::size_t first, std::size_t step) {
      return (all - std::min(all, first) + step - 1) / step;
    };
    sum += rows_bytes(count(width, pass.x, pass.step_x), count(height, pass.y, pass.step_y), bits);
  }
  return sum;
}

PngData png_data(PngBytes file) {
  PngData out;
  PngBytes rest = file.subspan(std::min(file.size(), png_signature_bytes));
  while (const auto chunk = take_png_chunk(rest)) {
    if (chunk->name == "IDAT") out.bytes += chunk->data.size();
    if (chunk->name == "IEND") return out;
  }
  out.cut_off = true;
  return out;
}

} // namespace rend
