#include "render/files/picture_file.h"

#include "render/files/input_file.h"
#include "render/files/jpeg.h"
#include "render/files/png.h"
#include "render/files/png_reader.h"
#include "sim/base/error.h"

#include <algorithm>
#include <fmt/format.h>
#include <string_view>

namespace rend {
namespace {

enum class PictureFormat { Png, Jpeg };

PictureFormat format_of(const std::filesystem::path& path) {
  const std::vector<std::uint8_t> first = first_bytes(path, 12);
  if (first.empty()) throw UserError(Exit::BadInput, {path.string()}, "the file is empty");
  const std::string kind = picture_kind(first);
  if (kind != "a PNG" && kind != "a JPEG")
    throw UserError(Exit::BadInput, {path.string()},
                    kind.empty() ? "this is not a PNG or JPEG file"
                                 : "this is " + kind + ", not a PNG or JPEG file");
  const std::size_t size = size_of_file(path);
  if (size > most_picture_bytes)
    throw UserError(Exit::BadInput, {path.string()},
                    fmt::format("the file has {} MB; at most {} are read", size / 1'000'000 + 1,
                                most_picture_bytes / 1'000'000));
  return kind == "a PNG" ? PictureFormat::Png : PictureFormat::Jpeg;
}

} // namespace

std::string picture_kind(std::span<const std::uint8_t> first) {
  const std::string_view start(reinterpret_cast<const char*>(first.data()),
                               std::min<std::size_t>(first.size(), 12));
  if (start.starts_with("\x89PNG\r\n\x1a\n")) return "a PNG";
  if (start.starts_with("\xff\xd8\xff")) return "a JPEG";
  if (start.starts_with("GIF8")) return "a GIF";
  if (start.starts_with("BM")) return "a BMP";
  if (start.starts_with("v/1\x01")) return "an OpenEXR";
  if (start.starts_with(std::string_view("II*\0", 4)) || start.starts_with(std::string_view("MM\0*", 4)))
    return "a TIFF";
  if (start.starts_with("RIFF") && start.size() == 12 && start.ends_with("WEBP")) return "a WebP";
  return "";
}

PictureInfo picture_info(const std::filesystem::path& path) {
  if (format_of(path) == PictureFormat::Jpeg) {
    const JpegInfo info = jpeg_info(path);
    return {info.width, info.height};
  }
  const PngInfo info = png_info(path);
  return {info.width, info.height};
}

Image read_picture(const std::filesystem::path& path) {
  return format_of(path) == PictureFormat::Jpeg ? read_jpeg(path) : read_png(path);
}

} // namespace rend
