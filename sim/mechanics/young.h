// Spring stiffness: given, or from Young's modulus E, Poisson's ratio ν and the thickness h of the sheet.
//
// A side of length c of a triangle with sides a, b, c and area A (van Gelder 1998; thesis 2.20):
//   k = h ( E/(1+ν) · A/c² + Eν/(1−ν²) · (a² + b² − c²)/(8A) )
// A side of length l of a rectangle l × w, and its diagonals (Baudet 2009; thesis 2.21, 2.22):
//   k = hE (w²(3ν+2) − l²) / (4lw(1+ν)),    k = hE (l² + w²) / (4lw(1+ν))
// Of another quad l and w are the means of opposite sides. Each face adds its own. Rectangles give E and ν back
// at ν = 1/3 alone; elsewhere G is exact, the sheet behaves as with ν_eff = 1/(3ν+2) and E_eff =
// 3E(1+3ν)/(2(2+3ν)).
#pragma once

#include "sim/mechanics/interaction.h"

namespace rend {

// Of the unit of the face of d that d stands for (the side d–α0(d); a diagonal).
using StiffnessOf = std::function<double(const EmbeddedMap&, Dart)>; // [N/m]
using StiffnessFormula = double (*)(const SpringMaterial&, const EmbeddedMap&, Dart);

// k of the request's element, or the formula where the springs have a material. UserError: neither, both, or a
// material for an interaction that has no formula (null). The formula refuses what it cannot serve, by name.
StiffnessOf stiffness_of(const InteractionRequest& request, StiffnessFormula formula);

double edge_stiffness(const SpringMaterial& material, const EmbeddedMap& map, Dart d);
double diagonal_stiffness(const SpringMaterial& material, const EmbeddedMap& map, Dart d);

// UserError: a solid has no bend, and its surface none either.
void refuse_bend_of_solid(const EmbeddedMap& map, const InteractionRequest& request);

bool has_inner_edge(const EmbeddedMap& map); // an edge between two faces of a sheet

} // namespace rend
