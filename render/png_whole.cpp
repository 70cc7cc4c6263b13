// Whether a PNG file is whole (PNG specification, 5.3): a signature, then chunks of length, name, data and
// CRC-32.
#include "render/png.h"

#ifdef REND_PNG
#include <algorithm>
#include <array>
#include <fstream>
#include <libdeflate.h>
#include <span>
#include <string_view>
#include <vector>

namespace rend {
namespace {

constexpr std::array<std::uint8_t, 8> signature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

using Bytes = std::span<const std::uint8_t>;

std::uint32_t number_at(Bytes bytes) { // big-endian
  return static_cast<std::uint32_t>(bytes[0]) << 24 | static_cast<std::uint32_t>(bytes[1]) << 16 |
         static_cast<std::uint32_t>(bytes[2]) << 8 | bytes[3];
}

struct Chunk {
  std::string_view name;
  Bytes data;
};

std::string_view as_text(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// Takes the first chunk off `rest`; none: it is not whole.
std::optional<Chunk> take_chunk(Bytes& rest) {
  constexpr std::size_t around = 12; // bytes of length, name and CRC
  if (rest.size() < around) return {};
  const std::size_t length = number_at(rest);
  if (rest.size() - around < length) return {};
  const Bytes checked = rest.subspan(4, 4 + length);
  const auto crc = libdeflate_crc32(0, checked.data(), checked.size());
  if (crc != number_at(rest.subspan(8 + length))) return {};
  rest = rest.subspan(around + length);
  return Chunk{as_text(checked.first(4)), checked.subspan(4)};
}

std::vector<std::uint8_t> content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) return {};
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(std::max<std::streamoff>(file.tellg(), 0)));
  file.seekg(0);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!file) bytes.clear();
  return bytes;
}

} // namespace

std::optional<std::string> text_of_whole_png(const std::filesystem::path& path, const std::string& keyword) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return {};
  const std::vector<std::uint8_t> bytes = content_of(path);
  if (bytes.size() < signature.size() || !std::equal(signature.begin(), signature.end(), bytes.begin()))
    return {};
  Bytes rest = Bytes(bytes).subspan(signature.size());
  std::string text;
  const std::string wanted = keyword + std::string(1, '\0');
  while (const auto chunk = take_chunk(rest)) {
    const std::string_view data = as_text(chunk->data);
    if (chunk->name == "tEXt" && data.starts_with(wanted)) text = data.substr(wanted.size());
    if (chunk->name == "IEND") return rest.empty() ? std::optional(text) : std::nullopt;
  }
  return {};
}

} // namespace rend

#else

namespace rend {

std::optional<std::string> text_of_whole_png(const std::filesystem::path&, const std::string&) {
  return {};
}

} // namespace rend

#endif
