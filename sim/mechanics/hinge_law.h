// The angular spring of a hinge A→B between two faces (thesis 6.2, fig. 6.23; design: mechanics, "Angular bending").
//
// Each side has two outer vertices, the far ends of the edges next to the hinge (the same vertex, twice, on a
// triangle). With u the unit vector of AB, an outer vertex M at distance d = |u × AM| from the hinge line, and θ the
// dihedral angle, the moment kθ + λθ̇ of the difference from rest acts on M by the force
//
//   ± (moment/(2d)) (u × AM)/d        (half each: two outer vertices a side)
//
// and on A and B by the opposite in the proportions 1 − t and t of M's projection on AB (corrected: the thesis gives
// it all to the nearer vertex, which leaves a torque). For triangles the force is −∇(½kθ²). θ is 0 for a flat pair,
// its sign follows from normals that agree across the hinge, and its difference from rest lies in (−π, π].
#pragma once

#include "sim/mechanics/interaction.h"

#include <array>

namespace rend {

// Particles in the order A, B, side one near A, near B, side two near A, near B.
using HingePoints = std::array<Vec3, 6>;

// θ in (−π, π]. A side without area, or a hinge without length, gives 0.
double hinge_angle(const HingePoints& x);

// ∂θ/∂x of the six, the outer ones' halves; all zero where the angle is not defined.
std::array<Vec3, 6> hinge_gradient(const HingePoints& x);

std::array<Vec3, 6> hinge_forces(const UnitParameters& p, const HingePoints& x, const HingePoints& v);
double hinge_energy(const UnitParameters& p, const HingePoints& x); // of triangles: the potential of the force

} // namespace rend
