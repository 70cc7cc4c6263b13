// A rectangular bar, from the origin to (lx, ly, lz), of nx × ny × nz boxes that are
//
//   hexahedra   not cut
//   tetrahedra  cut in six along the diagonal from the lowest corner to the highest, one for each order in
//               which a path may take its steps along x, y and z (Kuhn 1960): neighbours' cuts agree
//   prisms      cut in two along the diagonal of their base, parallel to z
//   mixed       in slices along x: hexahedra, prisms, boxes cut into pyramids and tetrahedra around their
//               centre, repeated. All faces between slices are quads. In a slice of the third sort the
//               pyramids on the sides y and z are cut into two tetrahedra, and those on the sides x stay whole.
#pragma once

#include "sim/base/settings.h"
#include "sim/mesh/cells.h"

namespace rend {

enum class BarPattern { Hexahedra, Tetrahedra, Prisms, Mixed };

struct BarShape {
  BarPattern pattern = BarPattern::Hexahedra;
  int nx = 1, ny = 1, nz = 1; // boxes along each axis
  Vec3 size = Vec3(1, 1, 1);  // lx, ly, lz [m]
  SettingsSource source = {};
};
template <> const Fields<BarShape>& fields_of();

constexpr int bar_darts_per_box = 6 * 24; // at most

CellMesh bar_cells(const BarShape& shape);

} // namespace rend
