// A picture as OpenGL gives it, as an image: the rows from the top, without alpha or with straight alpha.
#pragma once

#include "render/files/image.h"

#include <cstdint>
#include <span>

namespace rend {

// pixels: height x width x 4, sRGB premultiplied by alpha, row 0 at the bottom. transparent: the image has an
// alpha channel; otherwise every pixel is opaque.
Image picture_image(std::span<const std::uint8_t> pixels, int width, int height, bool transparent);

} // namespace rend
