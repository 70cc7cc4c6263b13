// Stretch: a spring along each side of each face (thesis 6.2.1, fig. 6.16), so that an edge between two faces
// carries two. Owner EdgeOfFace <0>; particles d and α0(d). The springs of one edge are summed into one row
// (cumulated).
#pragma once

#include "sim/mechanics/interaction.h"

namespace rend {

InteractionType stretch();

} // namespace rend
