// Colours: of a preset, of a quantity, of a fragment. All sRGB, 8 bits a channel.
#pragma once

#include "sim/base/parameters.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace rend {

using Colour = std::array<std::uint8_t, 3>;

// The colour "#rrggbb" that an attribute holds. UserError with its place where it holds none.
Colour colour_of(const PresetNode& node, std::string_view attribute);

// The colour of a quantity, share = 0 to 1 of its scale: viridis (van der Walt and Smith 2015), which is even
// to the eye, also to one that tells red from green badly. Values outside are as the nearest end.
Colour colour_of_share(double share);

// Colours to tell things apart: hues in steps of the golden ratio, so that any first n lie well spread; equally
// light, but for every other one (Oklch, Ottosson 2020).
Colour colour_of_number(std::size_t number);

// The smallest of 1, 2, 5, 10, 20, ... times a power of ten that is not below `value`; 0 for 0.
double rounded_up(double value);

} // namespace rend
