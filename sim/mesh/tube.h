// A rectangular tube along z, one layer of hexahedra thick, its outer hull from the origin to (lx, ly, lz)
// (thesis fig. 7.14: 32 hexahedra).
//
// Each of the four sides is divided equally into a quarter of the cells around, outside and inside alike, so
// that the corners are mitred and the mesh is conforming.
#pragma once

#include "sim/base/settings.h"
#include "sim/mesh/cells.h"

namespace rend {

struct TubeShape {
  int around = 8, along = 4; // cells; around is a multiple of 4
  Vec3 size = Vec3(1, 1, 1); // lx, ly, lz [m]
  double wall = 0.1;         // [m], less than half of lx and ly
  SettingsSource source = {};
};
template <> const Fields<TubeShape>& fields_of();

// CHECK: the shape satisfies the conditions above.
CellMesh tube_cells(const TubeShape& shape);

} // namespace rend
