// Where a surface crosses itself: then no solid has it as its boundary, and mesh generators fail on it.
//
// Pairs of triangles whose boxes overlap, found by a sweep along x: an edge of one passes through the other, or
// lies in its plane and overlaps it. Volumes of the tetrahedra of an edge and a triangle tell on which sides
// its ends are; what is within round-off of a plane touches it.
#pragma once

#include "sim/mesh/closed_surface.h"

#include <optional>

namespace rend {

// A point [m] at which two triangles cross or touch, apart from the corners and edges that they share; nullopt:
// none.
std::optional<Vec3> crossing_of(const ClosedSurface& surface);

} // namespace rend
