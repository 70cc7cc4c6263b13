// Shear in a volume: springs along the four diagonals of a hexahedron (thesis 6.2.3, fig. 6.20, 6.21).
//
// Isotropic: owner Volume <0,1,2>, all four diagonals with one stiffness; for rectangular hexahedra.
// Anisotropic: each diagonal on one of its ends, owner VertexOfVolume <1,2> (the end with the smaller dart),
// with its own stiffness; for any hexahedron. From a dart d the other end of the diagonal is α0α1α0α2α1α0(d):
// across the face, then along the edge that leaves it. The path printed in fig. 6.21 ends on a neighbouring
// corner.
#pragma once

#include "sim/mechanics/interaction.h"

namespace rend {

InteractionType shear_volume_isotropic();
InteractionType shear_volume_anisotropic();

} // namespace rend
