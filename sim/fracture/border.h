// The border between two elements of a sheet: an edge with both its faces, and the direction a tear would open it in.
#pragma once

#include "sim/program/binder.h"

namespace rend {

// Rows of the edges between two faces: vertices A = d and B = α0(d); with corners, also those of A and B in the face
// of d, then in the other. Owner Edge of a sheet <0,2>.
Binder bind_borders(EmbeddedMap& map, bool corners);

// The unit vector n along AB × (n1 + n2), in the sheet and across the edge of d; n1, n2 are the unit normals of its
// faces, made to agree across it (so that it works on a Möbius band); where they cancel, n1 alone counts. Zero where
// there is no direction.
Vec3 across_border(const EmbeddedMap& map, const Record* position, Dart d);

} // namespace rend
