// Pixels that differ only because an edge is smoothed differently, by the rule of pixelmatch (V. Vysniauskas,
// "Anti-aliased pixel and intensity slope detector", 2009; mapbox/pixelmatch).
//
// A pixel counts as smoothed in a picture where, of its eight neighbours, at most two have its brightness,
// there is a darker and a brighter one, and the darkest or the brightest of them lies in an area of one colour
// (three or more neighbours of the same colour) in both pictures. A pixel that differs is left out where it is
// smoothed in either picture. On the border of the picture what lies outside counts as one neighbour of the
// same brightness.
//
// The rule errs on the side of leaving out: a crack one pixel wide may look like a smoothed edge. It is off
// unless it is asked for.
#pragma once

#include "render/compare/difference.h"

#include <cstddef>

namespace rend {

// The mask, without the pixels that differ and are smoothed in a or b; their number is added to `left_out`.
// Pictures of one size, without alpha (CHECK).
PixelMask without_smoothed(const Picture& a, const Picture& b, const PixelMask& mask, std::size_t& left_out);

} // namespace rend
