// Shear in a face (thesis 6.2.2, fig. 6.17–6.19).
//
// Isotropic: both diagonals of a quad. Owner FaceOfVolume <0,1>; particles d and α0α1α0(d), α0(d) and α1α0(d).
// Anisotropic: at a corner, a spring between the far ends of its two edges. Owner VertexOfFace <1>; particles
// α0(d) and α0(α1(d)). In a quad two adjacent corners carry one each (each diagonal once), in a polygon of more
// sides every corner. A triangle has no diagonals.
#pragma once

#include "sim/mechanics/interaction.h"

namespace rend {

InteractionType shear_face_isotropic();
InteractionType shear_face_anisotropic();

} // namespace rend
