// Pictures whose brightness expressions use (sim/mechanics/mask.h), from files.
//
// Brightness is the luminance in linear light, of sRGB (IEC 61966-2-1), laid on white where it is transparent:
//
//   b = α (0.2126 R + 0.7152 G + 0.0722 B) + (1 − α)        R, G, B: 0 to 1, decoded
//
// so that black is 0, white is 1 and what is wholly transparent as well; a grey of the level 188 is a half: as
// much light as where every second pixel is white.
#pragma once

#include "sim/mechanics/mask.h"

#include <filesystem>
#include <memory>

namespace rend {

// UserError: as read_picture() throws it (files/picture_file.h); BadInput: larger than largest_texture.
std::shared_ptr<const Mask> read_mask(const std::filesystem::path& file);

} // namespace rend
