// Where a falling sphere touches a mesh that stands still: planes that keep its centre at its radius from the
// faces.
//
//   a centre whose path goes through a face   the plane of the first one, on the side from which it came
//   others                                    the tangent plane at the nearest point of each face in reach, but
//                                             for points that do not lie in front of the planes of nearer ones:
//                                             a valley has both its sides, a flat face no edges within it
#pragma once

#include "sim/contact/surface_tree.h"

#include <vector>

namespace rend {

// A centre that goes `from` → `to` [m] in the step.
std::vector<Plane> planes_against(const SurfaceTree& mesh, double radius, const Vec3& from, const Vec3& to);

} // namespace rend
