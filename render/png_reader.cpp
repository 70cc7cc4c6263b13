#include "render/png_reader.h"

#include "render/png.h"
#include "sim/base/error.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fmt/format.h>
#include <memory>

namespace rend {

std::vector<std::uint8_t> file_bytes(const std::filesystem::path& path) {
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  const Place place{path.string()};
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw UserError(Exit::NoInput, place, "this is a folder, and no picture");
  if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error))
    throw UserError(Exit::NoInput, place, "this is no ordinary file");
  const std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "rb"));
  if (!file)
    throw UserError(Exit::NoInput, place, fmt::format("it cannot be opened: {}", std::strerror(errno)));
  std::vector<std::uint8_t> bytes(std::filesystem::file_size(path, error));
  if (error) throw UserError(Exit::ReadWrite, place, "its size cannot be read: " + error.message());
  const std::size_t count = std::fread(bytes.data(), 1, bytes.size(), file.get());
  if (std::ferror(file.get()))
    throw UserError(Exit::ReadWrite, place, fmt::format("it cannot be read: {}", std::strerror(errno)));
  bytes.resize(count);
  return bytes;
}

} // namespace rend

#ifdef REND_PNG
#include <bit>
#include <csetjmp>
#include <new>
#include <png.h>
#include <string_view>

// libpng reports errors by longjmp: the functions that call setjmp below hold nothing that has a destructor.

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

// Up to the pixels. False: message says why; so with all below.
bool read_header(Reader& reader) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  png_read_info(reader.png, reader.info);
  return true;
}

bool prepare(Reader& reader, int& passes) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  png_set_expand(reader.png);
  png_set_gray_to_rgb(reader.png);
  if (std::endian::native == std::endian::little) png_set_swap(reader.png);
  passes = png_set_interlace_handling(reader.png);
  png_read_update_info(reader.png, reader.info);
  return true;
}

bool read_rows(Reader& reader, std::uint8_t* rows, std::size_t stride, int height, int passes) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  for (int pass = 0; pass < passes; ++pass)
    for (int y = 0; y < height; ++y)
      png_read_row(reader.png, rows + static_cast<std::size_t>(y) * stride, nullptr);
  png_read_end(reader.png, nullptr);
  return true;
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

// What a file that is no PNG is by its first bytes; empty where that cannot be told.
std::string other_kind(std::span<const std::uint8_t> bytes) {
  const std::string_view start(reinterpret_cast<const char*>(bytes.data()),
                               std::min<std::size_t>(bytes.size(), 12));
  if (start.starts_with("\xff\xd8\xff")) return "a JPEG";
  if (start.starts_with("GIF8")) return "a GIF";
  if (start.starts_with("BM")) return "a BMP";
  if (start.starts_with("v/1\x01")) return "an OpenEXR";
  if (start.starts_with(std::string_view("II*\0", 4)) || start.starts_with(std::string_view("MM\0*", 4)))
    return "a TIFF";
  if (start.starts_with("RIFF") && start.substr(8) == "WEBP") return "a WebP";
  return "";
}

void check_signature(std::span<const std::uint8_t> bytes, const Place& place) {
  if (bytes.empty()) throw UserError(Exit::BadInput, place, "the file is empty");
  if (png_sig_cmp(bytes.data(), 0, std::min<std::size_t>(bytes.size(), 8)) == 0 && bytes.size() >= 8) return;
  const std::string other = other_kind(bytes);
  throw UserError(Exit::BadInput, place,
                  other.empty() ? "this is no PNG" : "this is " + other + ", and no PNG");
}

// A picture as libpng gives it: RGB or RGBA, of 8 bits a channel, or of 16 in the machine's order of bytes.
struct Decoded {
  int width = 0, height = 0, channels = 0, bits = 0;
  std::vector<std::uint8_t> bytes; // height rows, one after another
  std::string kind;
};

Decoded decode(std::span<const std::uint8_t> bytes, const std::string& name) {
  const Place place{name};
  check_signature(bytes, place);
  Reader reader(bytes);
  const auto refuse = [&]() -> UserError {
    if (std::strstr(reader.message, "emory") != nullptr) throw std::bad_alloc(); // libpng had none
    return {Exit::BadInput, place, std::string("the PNG cannot be read: ") + reader.message};
  };
  if (!read_header(reader)) throw refuse();
  Decoded out;
  out.width = static_cast<int>(png_get_image_width(reader.png, reader.info));
  out.height = static_cast<int>(png_get_image_height(reader.png, reader.info));
  out.kind = kind_of(reader);
  if (static_cast<long>(out.width) * out.height > max_png_pixels)
    throw UserError(Exit::BadInput, place,
                    fmt::format("it says that it has {} x {} pixels, and at most {} are read", out.width,
                                out.height, max_png_pixels));
  int passes = 0;
  if (!prepare(reader, passes)) throw refuse();
  out.channels = png_get_channels(reader.png, reader.info);
  out.bits = png_get_bit_depth(reader.png, reader.info);
  const std::size_t stride = png_get_rowbytes(reader.png, reader.info);
  out.bytes.resize(stride * static_cast<std::size_t>(out.height));
  if (!read_rows(reader, out.bytes.data(), stride, out.height, passes)) throw refuse();
  return out;
}

std::vector<std::uint16_t> samples_of(const Decoded& from) {
  if (from.bits == 8) return {from.bytes.begin(), from.bytes.end()};
  std::vector<std::uint16_t> out(from.bytes.size() / 2);
  std::memcpy(out.data(), from.bytes.data(), from.bytes.size());
  return out;
}

} // namespace

DeepImage read_deep_png(std::span<const std::uint8_t> bytes, const std::string& name) {
  const Decoded from = decode(bytes, name);
  return {from.width, from.height, from.channels, from.bits, samples_of(from), from.kind};
}

Image read_png(const std::filesystem::path& path) {
  Decoded from = decode(file_bytes(path), path.string());
  Image image(from.width, from.height, from.channels);
  if (from.bits == 8) {
    image.pixels = std::move(from.bytes);
  } else {
    const std::vector<std::uint16_t> samples = samples_of(from);
    for (std::size_t n = 0; n < samples.size(); ++n)
      image.pixels[n] = static_cast<std::uint8_t>(samples[n] >> 8);
  }
  return image;
}

} // namespace rend

#else

namespace rend {

DeepImage read_deep_png(std::span<const std::uint8_t>, const std::string&) {
  require_png();
  return {};
}
Image read_png(const std::filesystem::path&) {
  require_png();
  return {};
}

} // namespace rend

#endif
