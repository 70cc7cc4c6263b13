// Bending by an angular spring on each edge between two triangles or quads (thesis 6.2.4, fig. 6.23;
// hinge_law.h). Owner Edge of the sheet <0,2>; particles: on each side the hinge d, α0(d), then the far ends of
// the two edges next to it; no force once the edge is separated.
#pragma once

#include "sim/mechanics/interaction.h"

namespace rend {

InteractionType bend_angular();

} // namespace rend
