#include "render/files/png.h"

#include "render/files/output.h"
#include "sim/base/error.h"

#ifdef REND_PNG
#include <algorithm>
#include <libdeflate.h>
#include <memory>
#include <new>
#include <png.h>
#include <span>

namespace rend {
namespace {

using Bytes = std::vector<std::uint8_t>;

void append(Bytes& out, std::uint32_t number) { // big-endian
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<std::uint8_t>(number >> shift));
}

void append_chunk(Bytes& out, const char* kind, std::span<const std::uint8_t> content) {
  append(out, static_cast<std::uint32_t>(content.size()));
  const std::size_t first = out.size();
  out.insert(out.end(), kind, kind + 4);
  out.insert(out.end(), content.begin(), content.end());
  append(out, libdeflate_crc32(0, out.data() + first, out.size() - first));
}

// Kept per thread, since a new one for each picture would take a sixth of the time.
struct Workspace {
  struct Free {
    void operator()(libdeflate_compressor* compressor) const { libdeflate_free_compressor(compressor); }
  };
  std::unique_ptr<libdeflate_compressor, Free> compressor{libdeflate_alloc_compressor(1)};
  Bytes rows, deflated;

  // Frees large buffers after a huge picture; allocating them again is negligible beside its encoding.
  void release_large_buffers() {
    constexpr std::size_t much = 64 << 20; // bytes
    for (Bytes* bytes : {&rows, &deflated})
      if (bytes->capacity() > much) *bytes = Bytes();
  }
};

// Prefixes each row with its filter type: 1, SUB, the difference from the pixel to the left.
void filter(const Image& image, Bytes& rows) {
  const std::size_t step = static_cast<std::size_t>(image.channels), stride = image.stride();
  rows.resize((stride + 1) * image.height);
  std::uint8_t* to = rows.data();
  for (int y = 0; y < image.height; ++y, to += stride) {
    const std::uint8_t* from = image.row(y);
    *to++ = 1;
    std::copy(from, from + step, to);
    for (std::size_t x = step; x < stride; ++x) to[x] = static_cast<std::uint8_t>(from[x] - from[x - step]);
  }
}

std::span<const std::uint8_t> deflated_rows(const Image& image, Workspace& work) {
  libdeflate_compressor* compressor = work.compressor.get();
  if (compressor == nullptr) throw std::bad_alloc();
  filter(image, work.rows);
  work.deflated.resize(libdeflate_zlib_compress_bound(compressor, work.rows.size()));
  const std::size_t size = libdeflate_zlib_compress(compressor, work.rows.data(), work.rows.size(),
                                                    work.deflated.data(), work.deflated.size());
  CHECK(size > 0);
  return {work.deflated.data(), size};
}

} // namespace

bool png_available() {
  return true;
}
void require_png() {}

std::vector<std::uint8_t> encode_png(const Image& image, const PngText& text) {
  CHECK(image.width > 0 && image.height > 0 && image.pixels.size() == image.stride() * image.height);
  Bytes out{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'}, head;
  append(head, static_cast<std::uint32_t>(image.width));
  append(head, static_cast<std::uint32_t>(image.height));
  const std::uint8_t colours = image.channels == 4 ? PNG_COLOR_TYPE_RGBA : PNG_COLOR_TYPE_RGB;
  // bit depth, colour type; deflate, adaptive filtering, no interlacing
  head.insert(head.end(), {8, colours, 0, 0, 0});
  append_chunk(out, "IHDR", head);
  if (!text.keyword.empty()) {
    Bytes content(text.keyword.begin(), text.keyword.end());
    content.push_back(0);
    content.insert(content.end(), text.text.begin(), text.text.end());
    append_chunk(out, "tEXt", content);
  }
  thread_local Workspace work;
  const std::span<const std::uint8_t> rows = deflated_rows(image, work);
  // room for the names, lengths and CRCs of the last two chunks as well
  out.reserve(out.size() + rows.size() + 64);
  append_chunk(out, "IDAT", rows);
  append_chunk(out, "IEND", {});
  work.release_large_buffers();
  return out;
}

void write_png(const std::filesystem::path& path, const Image& image, const PngText& text) {
  OutputFile file(path);
  file.write(encode_png(image, text));
  file.commit();
}

} // namespace rend

#else

namespace rend {

bool png_available() {
  return false;
}
void require_png() {
  throw UserError(Exit::Usage, {}, "this rend was built without PNG",
                  "make only a video (--video mp4 --no-png), or build rend with -DREND_PNG=ON");
}
std::vector<std::uint8_t> encode_png(const Image&, const PngText&) {
  require_png();
  return {};
}
void write_png(const std::filesystem::path&, const Image&, const PngText&) {
  require_png();
}

} // namespace rend

#endif
