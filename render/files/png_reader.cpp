#include "render/files/png_reader.h"

#include "render/files/input_file.h"
#include "render/files/picture_file.h"
#include "render/files/png.h"
#include "render/files/png_chunks.h"
#include "sim/base/error.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fmt/format.h>

namespace rend {

bool PngInfo::is_plausible() const {
  return rows_bytes <= most_inflated * file_bytes;
}

namespace {

constexpr std::size_t sample = sizeof(std::uint16_t), channels = 4;

std::size_t row_bytes(const PngInfo& head) {
  return static_cast<std::size_t>(head.width) * channels * sample;
}

} // namespace

// Besides the file: libpng keeps two rows.
std::size_t PngInfo::checking_bytes() const {
  return file_bytes + 3 * row_bytes(*this);
}

std::size_t PngInfo::decoding_bytes() const {
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  return checking_bytes() + pixels * channels * (static_cast<std::size_t>(bits) / 8 + sample);
}

} // namespace rend

#ifdef REND_PNG
#include <bit>
#include <csetjmp>
#include <new>
#include <png.h>

// libpng reports errors by longjmp: the functions below that call setjmp have no local objects with
// destructors.

namespace rend {
namespace {

struct Source {
  const std::uint8_t* next;
  std::size_t left;
};

struct Reader {
  char message[200] = {};
  Source source;
  png_structp png = nullptr;
  png_infop info = nullptr;
  explicit Reader(std::span<const std::uint8_t> bytes) : source{bytes.data(), bytes.size()} {
    png = png_create_read_struct(PNG_LIBPNG_VER_STRING, message, on_error, [](png_structp, png_const_charp) {});
    if (png != nullptr) info = png_create_info_struct(png);
    if (info == nullptr) throw std::bad_alloc();
    png_set_read_fn(png, &source, take);
    png_set_user_limits(png, 0x7fffffff, 0x7fffffff);
  }
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  static void on_error(png_structp png, png_const_charp text) {
    std::snprintf(static_cast<char*>(png_get_error_ptr(png)), sizeof message, "%s", text);
    png_longjmp(png, 1);
  }
  static void take(png_structp png, png_bytep data, size_t count) {
    auto* source = static_cast<Source*>(png_get_io_ptr(png));
    if (source->left < count) png_error(png, "it is cut off");
    std::memcpy(data, source->next, count);
    source->next += count;
    source->left -= count;
  }
};

// Reads up to the pixels. False on error, with the message set; likewise below.
bool read_header(Reader& reader) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  // Text chunks and profiles do not affect the pixels, and each can inflate to megabytes.
  png_set_keep_unknown_chunks(reader.png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
  png_read_info(reader.png, reader.info);
  return true;
}

bool prepare(Reader& reader, bool as_8_bits, int& passes) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  png_set_expand(reader.png);
  if (as_8_bits) png_set_strip_16(reader.png);
  png_set_gray_to_rgb(reader.png);
  if (std::endian::native == std::endian::little) png_set_swap(reader.png);
  passes = png_set_interlace_handling(reader.png);
  png_read_update_info(reader.png, reader.info);
  return true;
}

bool read_row(Reader& reader, std::uint8_t* row) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  png_read_row(reader.png, row, nullptr);
  return true;
}

bool read_end(Reader& reader) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  png_read_end(reader.png, nullptr);
  return true;
}

// The buffer grows with the rows that were read, so that a header with a false size takes little memory. The
// first pass of an interlaced picture is spread over all rows.
bool read_rows(Reader& reader, std::size_t height, int passes, std::vector<std::uint8_t>& out) {
  constexpr std::size_t at_first = 64 << 20; // bytes: most pictures are smaller
  const std::size_t stride = png_get_rowbytes(reader.png, reader.info), all = stride * height;
  out.reserve(std::min(all, at_first));
  if (passes > 1) out.resize(all);
  for (int pass = 0; pass < passes; ++pass)
    for (std::size_t y = 0; y < height; ++y) {
      const std::size_t end = stride * (y + 1);
      if (end > out.capacity()) out.reserve(std::max(end, std::min(all, 2 * out.capacity())));
      if (end > out.size()) out.resize(end);
      if (!read_row(reader, out.data() + stride * y)) return false;
    }
  return read_end(reader);
}

bool skim_rows(Reader& reader, std::size_t height, int passes) {
  std::vector<std::uint8_t> row(png_get_rowbytes(reader.png, reader.info));
  for (std::size_t n = 0; n < height * static_cast<std::size_t>(passes); ++n)
    if (!read_row(reader, row.data())) return false;
  return read_end(reader);
}

std::string kind_of(const Reader& reader) {
  const int colour = png_get_color_type(reader.png, reader.info);
  std::string kind = colour == PNG_COLOR_TYPE_GRAY         ? "grey"
                     : colour == PNG_COLOR_TYPE_GRAY_ALPHA ? "grey and alpha"
                     : colour == PNG_COLOR_TYPE_PALETTE    ? "palette"
                     : colour == PNG_COLOR_TYPE_RGB        ? "RGB"
                                                           : "RGB and alpha";
  const int bits = png_get_bit_depth(reader.png, reader.info);
  kind += fmt::format(", {} bit{}", bits, bits == 1 ? "" : "s");
  if (png_get_valid(reader.png, reader.info, PNG_INFO_tRNS) != 0) kind += ", transparent colours";
  if (png_get_interlace_type(reader.png, reader.info) != PNG_INTERLACE_NONE) kind += ", interlaced";
  return kind;
}

void check_signature(std::span<const std::uint8_t> bytes, const Place& place) {
  if (bytes.empty()) throw UserError(Exit::BadInput, place, "the file is empty");
  if (has_png_signature(bytes)) return;
  const std::string other = picture_kind(bytes);
  throw UserError(Exit::BadInput, place,
                  other.empty() ? "this is not a PNG file" : "this is " + other + ", not a PNG file");
}

// Pixels as libpng returns them: RGB or RGBA, 8 bits a channel, or 16 bits in native byte order.
struct Decoded {
  int width = 0, height = 0, channels = 0, bits = 0;
  std::vector<std::uint8_t> bytes; // `height` rows, one after another
  std::string kind;
};

void check_pixels(std::size_t width, std::size_t height, const Place& place) {
  if (width * height > static_cast<std::size_t>(max_png_pixels))
    throw UserError(Exit::BadInput, place,
                    fmt::format("its header says {} x {} pixels, but rend reads at most {}", width, height,
                                max_png_pixels));
}

// Checks that the compressed data can hold the stated size, before memory is allocated.
void check_data(const Reader& reader, std::span<const std::uint8_t> bytes, const Place& place) {
  const auto width = png_get_image_width(reader.png, reader.info),
             height = png_get_image_height(reader.png, reader.info);
  const PngHeader header{width,
                         height,
                         png_get_bit_depth(reader.png, reader.info),
                         png_get_color_type(reader.png, reader.info),
                         0,
                         0,
                         png_get_interlace_type(reader.png, reader.info)};
  const PngData data = png_data(bytes);
  if (png_rows_bytes(header) <= most_inflated * data.bytes) return;
  const std::string why =
      data.cut_off ? "it is cut off"
                   : fmt::format("its header says {} x {} pixels, but its {} bytes of data cannot hold them",
                                 width, height, data.bytes);
  throw UserError(Exit::BadInput, place, "the PNG cannot be read: " + why);
}

enum class Want { Deep, EightBits, Nothing };

Decoded decode(std::span<const std::uint8_t> bytes, const std::string& name, Want want) {
  const Place place{name};
  check_signature(bytes, place);
  Reader reader(bytes);
  const auto refuse = [&]() -> UserError {
    // libpng's own allocation failed
    if (std::strstr(reader.message, "emory") != nullptr) throw std::bad_alloc();
    return {Exit::BadInput, place, std::string("the PNG cannot be read: ") + reader.message};
  };
  if (!read_header(reader)) throw refuse();
  Decoded out;
  const std::size_t width = png_get_image_width(reader.png, reader.info),
                    height = png_get_image_height(reader.png, reader.info);
  out.kind = kind_of(reader);
  check_pixels(width, height, place);
  check_data(reader, bytes, place);
  out.width = static_cast<int>(width);
  out.height = static_cast<int>(height);
  int passes = 0;
  if (!prepare(reader, want == Want::EightBits, passes)) throw refuse();
  out.channels = png_get_channels(reader.png, reader.info);
  out.bits = png_get_bit_depth(reader.png, reader.info);
  const bool read =
      want == Want::Nothing ? skim_rows(reader, height, passes) : read_rows(reader, height, passes, out.bytes);
  if (!read) throw refuse();
  return out;
}

// Widens samples of one or two bytes to 16 bits.
std::vector<std::uint16_t> samples_of(const Decoded& from) {
  if (from.bits == 8) return {from.bytes.begin(), from.bytes.end()};
  std::vector<std::uint16_t> out(from.bytes.size() / 2);
  std::memcpy(out.data(), from.bytes.data(), from.bytes.size());
  return out;
}

UserError no_memory(const std::string& name) {
  return {Exit::OutOfBudget, {name}, "there is not enough memory to read this picture"};
}

} // namespace

PngInfo png_info(std::span<const std::uint8_t> bytes, const std::string& name) {
  const Place place{name};
  check_signature(bytes, place);
  PngInfo head;
  head.file_bytes = bytes.size();
  const auto header = png_header(bytes);
  if (!header || header->width == 0 || header->height == 0) return head; // the reader will report what is wrong
  check_pixels(header->width, header->height, place);
  head.width = static_cast<int>(header->width);
  head.height = static_cast<int>(header->height);
  head.bits = header->bits == 16 ? 16 : 8;
  head.rows_bytes = png_rows_bytes(*header);
  return head;
}

PngInfo png_info(const std::filesystem::path& path) {
  PngInfo head = png_info(first_bytes(path, png_header_bytes), path.string());
  head.file_bytes = size_of_file(path);
  return head;
}

HighDepthImage read_high_depth_png(std::span<const std::uint8_t> bytes, const std::string& name) {
  try {
    const Decoded from = decode(bytes, name, Want::Deep);
    return {from.width, from.height, from.channels, from.bits, samples_of(from), from.kind};
  } catch (const std::bad_alloc&) {
    throw no_memory(name);
  }
}

void check_png(std::span<const std::uint8_t> bytes, const std::string& name) {
  try {
    decode(bytes, name, Want::Nothing);
  } catch (const std::bad_alloc&) {
    throw no_memory(name);
  }
}

Image read_png(const std::filesystem::path& path) {
  try {
    Decoded from = decode(file_bytes(path), path.string(), Want::EightBits);
    Image image;
    image.width = from.width;
    image.height = from.height;
    image.channels = from.channels;
    image.pixels = std::move(from.bytes);
    return image;
  } catch (const std::bad_alloc&) {
    throw no_memory(path.string());
  }
}

} // namespace rend

#else

namespace rend {

PngInfo png_info(const std::filesystem::path&) {
  require_png();
  return {};
}
PngInfo png_info(std::span<const std::uint8_t>, const std::string&) {
  require_png();
  return {};
}
HighDepthImage read_high_depth_png(std::span<const std::uint8_t>, const std::string&) {
  require_png();
  return {};
}
void check_png(std::span<const std::uint8_t>, const std::string&) {
  require_png();
}
Image read_png(const std::filesystem::path&) {
  require_png();
  return {};
}

} // namespace rend

#endif
