// Spring stiffness: given, or from Young's modulus E, Poisson's ratio ν and the thickness h of the sheet.
//
// A side of length c of a triangle with sides a, b, c and area A (van Gelder 1998; thesis 2.20):
//   k = h ( E/(1+ν) · A/c² + Eν/(1−ν²) · (a² + b² − c²)/(8A) )
// A side of length l of a rectangle l × w, and its diagonals (Baudet 2009; thesis 2.21, 2.22):
//   k = hE (w²(3ν+2) − l²) / (4lw(1+ν)),    k = hE (l² + w²) / (4lw(1+ν))
// For other quads l and w are the means of opposite sides. Each face contributes its own springs. Rectangles
// reproduce E and ν only at ν = 1/3; otherwise G is exact, and the sheet behaves as with ν_eff = 1/(3ν+2) and
// E_eff = 3E(1+3ν)/(2(2+3ν)).
#pragma once

#include "sim/mechanics/interaction.h"

namespace rend {

// The stiffness of one unit of the face of d: the side d–α0(d), or a diagonal.
using StiffnessOf = std::function<double(const EmbeddedMap&, Dart)>; // [N/m]
using StiffnessFormula = double (*)(const SpringMaterial&, const EmbeddedMap&, Dart);

// k as given, or from the formula if the springs have a material. UserError: neither, both, or a material for
// an interaction without formula (null). The formula itself refuses faces that it does not support, by name.
StiffnessOf stiffness_of(const InteractionRequest& request, StiffnessFormula formula);

double edge_stiffness(const SpringMaterial& material, const EmbeddedMap& map, Dart d);
double diagonal_stiffness(const SpringMaterial& material, const EmbeddedMap& map, Dart d);

// UserError: bending is for sheets, not for a solid or its surface.
void refuse_bend_of_solid(const EmbeddedMap& map, const InteractionRequest& request);

bool has_inner_edge(const EmbeddedMap& map); // an edge between two faces of a sheet

} // namespace rend
