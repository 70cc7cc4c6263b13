// The outline of a drawing: what the shapes of an SVG file fill.
//
// Read are <path>, <rect>, <circle>, <ellipse>, <polygon> and <polyline> (which is closed), with the
// `transform` of each and of the groups around it (translate, scale, rotate, skewX, skewY, matrix). The y axis
// is turned over, so that the outline stands as the drawing does. Colours say nothing, but for fill="none" and
// display="none", as attributes or in a style: such shapes fill nothing. What is only defined (<defs>,
// <clipPath>, gradients ...), and what other programs write for themselves, is passed over; what would be drawn
// and cannot be read (<text>, <image>, <use>) is refused. As everywhere, what lies within an odd number of all
// curves is inside: a shape within a shape is a hole.
#pragma once

#include "sim/mesh/outline.h"
#include "sim/mesh/source.h"

namespace rend {

// UserError, with its place in the file: it is not XML or no SVG, a shape cannot be read, nothing is filled.
Outline outline_of_svg(const MeshSource& file);

} // namespace rend
