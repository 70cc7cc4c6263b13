#include "render/png.h"

#include "render/output.h"
#include "sim/base/error.h"

#ifdef REND_PNG
#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <libdeflate.h>
#include <memory>
#include <new>
#include <png.h>
#include <span>

namespace rend {
namespace {

using Bytes = std::vector<std::uint8_t>;

void append(Bytes& out, std::uint32_t number) { // in network byte order
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<std::uint8_t>(number >> shift));
}

void append_chunk(Bytes& out, const char* kind, std::span<const std::uint8_t> content) {
  append(out, static_cast<std::uint32_t>(content.size()));
  const std::size_t first = out.size();
  out.insert(out.end(), kind, kind + 4);
  out.insert(out.end(), content.begin(), content.end());
  append(out, libdeflate_crc32(0, out.data() + first, out.size() - first));
}

// Each row behind the number of its filter: 1, SUB, what a pixel differs by from the one before it.
Bytes filtered(const Image& image) {
  const std::size_t step = static_cast<std::size_t>(image.channels), stride = image.stride();
  Bytes rows((stride + 1) * image.height);
  std::uint8_t* to = rows.data();
  for (int y = 0; y < image.height; ++y, to += stride) {
    const std::uint8_t* from = image.row(y);
    *to++ = 1;
    std::copy(from, from + step, to);
    for (std::size_t x = step; x < stride; ++x) to[x] = static_cast<std::uint8_t>(from[x] - from[x - step]);
  }
  return rows;
}

Bytes deflated(const Bytes& bytes) {
  struct Free {
    void operator()(libdeflate_compressor* compressor) const { libdeflate_free_compressor(compressor); }
  };
  const std::unique_ptr<libdeflate_compressor, Free> compressor(libdeflate_alloc_compressor(1));
  if (!compressor) throw std::bad_alloc();
  Bytes out(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()));
  out.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), out.data(), out.size()));
  CHECK(!out.empty());
  return out;
}

// libpng reports errors by longjmp: the functions that call setjmp below hold nothing that has a destructor.

struct Message {
  char text[200] = {};
};

void on_error(png_structp png, png_const_charp text) {
  auto* message = static_cast<Message*>(png_get_error_ptr(png));
  std::snprintf(message->text, sizeof message->text, "%s", text);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

struct Reader {
  Message message;
  png_structp png = nullptr;
  png_infop info = nullptr;
  Reader() {
    png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &message, on_error, on_warning);
    if (png != nullptr) info = png_create_info_struct(png);
    if (info == nullptr) throw std::bad_alloc();
  }
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
};

// Reads up to the pixels, and says how large they are once brought to 8 bits. False: message says why.
bool read_header(Reader& reader, std::FILE* file, int& width, int& height, int& channels, int& passes) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  png_init_io(reader.png, file);
  png_read_info(reader.png, reader.info);
  png_set_expand(reader.png);
  png_set_strip_16(reader.png);
  png_set_gray_to_rgb(reader.png);
  passes = png_set_interlace_handling(reader.png);
  png_read_update_info(reader.png, reader.info);
  width = static_cast<int>(png_get_image_width(reader.png, reader.info));
  height = static_cast<int>(png_get_image_height(reader.png, reader.info));
  channels = png_get_channels(reader.png, reader.info);
  return true;
}

bool read_rows(Reader& reader, Image& image, int passes) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  for (int pass = 0; pass < passes; ++pass)
    for (int y = 0; y < image.height; ++y) png_read_row(reader.png, image.row(y), nullptr);
  png_read_end(reader.png, nullptr);
  return true;
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
  head.insert(head.end(), {8, colours, 0, 0, 0}); // bits; deflated, filtered by rows, not interlaced
  append_chunk(out, "IHDR", head);
  if (!text.keyword.empty()) {
    Bytes content(text.keyword.begin(), text.keyword.end());
    content.push_back(0);
    content.insert(content.end(), text.text.begin(), text.text.end());
    append_chunk(out, "tEXt", content);
  }
  append_chunk(out, "IDAT", deflated(filtered(image)));
  append_chunk(out, "IEND", {});
  return out;
}

void write_png(const std::filesystem::path& path, const Image& image, const PngText& text) {
  OutputFile file(path);
  file.write(encode_png(image, text));
  file.commit();
}

Image read_png(const std::filesystem::path& path) {
  const Place place{path.string()};
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  const std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "rb"));
  if (!file) throw UserError(Exit::NoInput, place, "the picture cannot be opened.");
  Reader reader;
  const auto refuse = [&] {
    throw UserError(Exit::BadInput, place,
                    std::string("this is not a PNG that can be read: ") + reader.message.text);
  };
  int width = 0, height = 0, channels = 0, passes = 0;
  if (!read_header(reader, file.get(), width, height, channels, passes)) refuse();
  Image image(width, height, channels);
  if (!read_rows(reader, image, passes)) refuse();
  return image;
}

} // namespace rend

#else

namespace rend {

bool png_available() {
  return false;
}
void require_png() {
  throw UserError(Exit::Usage, {}, "this rend was built without PNG",
                  "ask for a video alone (--video mp4 --no-png), or build with -DREND_PNG=ON");
}
std::vector<std::uint8_t> encode_png(const Image&, const PngText&) {
  require_png();
  return {};
}
void write_png(const std::filesystem::path&, const Image&, const PngText&) {
  require_png();
}
Image read_png(const std::filesystem::path&) {
  require_png();
  return {};
}

} // namespace rend

#endif
