#include "render/picture/mask_file.h"

#include "render/draw/light_average.h"
#include "render/draw/texture.h"
#include "render/files/picture_file.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {
namespace {

constexpr const char* damaged = "save the picture again, as a complete PNG or JPEG file";

// By the header, before anything is decoded.
void check_mask_size(const std::filesystem::path& file) {
  const PictureInfo info = picture_info(file);
  if (info.width < 1 || info.height < 1)
    throw UserError(Exit::BadInput, {file.string()}, "it does not begin with its size: its header is damaged",
                    damaged);
  if (std::max(info.width, info.height) > largest_texture)
    throw UserError(Exit::BadInput, {file.string()},
                    fmt::format("it is a picture of {0} x {1} pixels; at most {2} x {2} are allowed",
                                info.width, info.height, largest_texture),
                    "make it smaller: elements are larger than its pixels");
}

// In whole numbers, so that white is 1 exactly.
float brightness_of(const std::uint8_t* pixel, int channels) {
  constexpr std::uint64_t white = std::uint64_t{65535} * 10000;
  const std::uint64_t light = std::uint64_t{2126} * light_of_level(pixel[0]) +
                              std::uint64_t{7152} * light_of_level(pixel[1]) +
                              std::uint64_t{722} * light_of_level(pixel[2]);
  const std::uint64_t alpha = channels == 4 ? pixel[3] : 255;
  return static_cast<float>(static_cast<double>(alpha * light + (255 - alpha) * white) /
                            static_cast<double>(255 * white));
}

} // namespace

std::shared_ptr<const Mask> read_mask(const std::filesystem::path& file) try {
  check_mask_size(file);
  const Image image = read_picture(file);
  auto mask = std::make_shared<Mask>();
  mask->width = image.width;
  mask->height = image.height;
  mask->brightness.reserve(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      mask->brightness.push_back(brightness_of(image.at(x, y), image.channels));
  return mask;
} catch (const UserError& error) {
  if (error.code != Exit::BadInput || !error.hint.empty()) throw;
  throw UserError(error.code, {}, error.what(), damaged);
}

} // namespace rend
