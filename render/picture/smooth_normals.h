// Normals of the smooth surface that the mesh of a sheet approximates.
//
// A crossed mesh folds in small pyramids, one a cell: the middle of a cell lies above or below its corners, and
// shading by the normals of vertices shows every cell. So a vertex takes the mean of the normals around it,
//
//   n'_v = unit Σ_t A_t (n_a + n_b + n_c),   t: the triangles (a, b, c) at v, A_t: their areas,
//
// each turned to the side of its triangle that n_v is on, and this twice over. Tears separate vertices, so that
// nothing is smoothed across them.
#pragma once

#include "sim/base/math.h"
#include "sim/base/record.h"
#include "sim/boundary/surface.h"

#include <vector>

namespace rend {

// x: positions [m]; normals: unit or 0, of arbitrary sign; both one per vertex slot. `sums`: scratch memory.
void smooth_normals(const Surface& sheet, const std::vector<Record>& x, std::vector<Vec3>& normals,
                    std::vector<Vec3>& sums);

} // namespace rend
