#include "render/png.h"

#include "render/output.h"
#include "sim/base/error.h"

#ifdef REND_PNG
#include <csetjmp>
#include <cstdio>
#include <memory>
#include <new>
#include <png.h>

// libpng reports errors by longjmp: the functions that call setjmp below hold nothing that has a destructor.

namespace rend {
namespace {

struct Message {
  char text[200] = {};
};

void on_error(png_structp png, png_const_charp text) {
  auto* message = static_cast<Message*>(png_get_error_ptr(png));
  std::snprintf(message->text, sizeof message->text, "%s", text);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

void append(png_structp png, png_bytep data, size_t count) {
  auto* bytes = static_cast<std::vector<std::uint8_t>*>(png_get_io_ptr(png));
  bool stored = true;
  try {
    bytes->insert(bytes->end(), data, data + count);
  } catch (const std::bad_alloc&) {
    stored = false;
  }
  if (!stored) png_error(png, "out of memory");
}

struct Writer {
  Message message;
  png_structp png = nullptr;
  png_infop info = nullptr;
  Writer() {
    png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &message, on_error, on_warning);
    if (png != nullptr) info = png_create_info_struct(png);
    if (info == nullptr) throw std::bad_alloc();
  }
  ~Writer() { png_destroy_write_struct(&png, &info); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
};

// False: message says why.
bool write_rows(Writer& writer, const Image& image, std::vector<std::uint8_t>* bytes) {
  if (setjmp(png_jmpbuf(writer.png)) != 0) return false;
  png_set_write_fn(writer.png, bytes, append, nullptr);
  png_set_IHDR(writer.png, writer.info, static_cast<png_uint_32>(image.width),
               static_cast<png_uint_32>(image.height), 8,
               image.channels == 4 ? PNG_COLOR_TYPE_RGBA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_compression_level(writer.png, 1);
  png_set_filter(writer.png, 0, PNG_FILTER_SUB);
  png_write_info(writer.png, writer.info);
  for (int y = 0; y < image.height; ++y) png_write_row(writer.png, image.row(y));
  png_write_end(writer.png, nullptr);
  return true;
}

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

std::vector<std::uint8_t> encode_png(const Image& image) {
  CHECK(image.width > 0 && image.height > 0 && image.pixels.size() == image.stride() * image.height);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(image.pixels.size() / 4);
  Writer writer;
  CHECK_NOTE(write_rows(writer, image, &bytes), writer.message.text);
  return bytes;
}

void write_png(const std::filesystem::path& path, const Image& image) {
  OutputFile file(path);
  file.write(encode_png(image));
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
std::vector<std::uint8_t> encode_png(const Image&) {
  require_png();
  return {};
}
void write_png(const std::filesystem::path&, const Image&) {
  require_png();
}
Image read_png(const std::filesystem::path&) {
  require_png();
  return {};
}

} // namespace rend

#endif
