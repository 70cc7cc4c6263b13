// Bending by springs over two edges (Provot 1995; thesis 6.2.4, fig. 6.22): at each end of an edge between two
// faces, a spring between the far ends of the two edges that continue across. Owner EdgeEndOfVolume <2>;
// particles α0(α1(d)) and α0(α1(α2(d))); no force once the edge is separated.
//
// Springs between the same two particles are summed into one row: on triangles those of the two ends of an edge
// (word 0), on quads those of the two opposite edges at a vertex of valence four (word 121).
#pragma once

#include "sim/mechanics/interaction.h"

namespace rend {

InteractionType bend_provot();

} // namespace rend
