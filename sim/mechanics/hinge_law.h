// The angular spring of a hinge A→B between two faces (thesis 6.2, fig. 6.23; design: mechanics, "Angular bending").
//
// Each side has two outer vertices, the far ends of the edges next to the hinge (the same vertex, twice, on a
// triangle), and P between them. With u the unit vector of AB, d = |u × AP| the distance of P from the hinge line, and
// θ the dihedral angle of the triangles ABP, the moment kθ + λθ̇ of the difference from rest acts on P, half on each of
// the two, by the force
//
//   ± (moment/d) (u × AP)/d
//
// and on A and B, as ends of its own side, by the opposite in the proportions 1 − t and t of P's projection on AB. It is
// −∇(½kθ²) for every shape of cell. Corrected against the thesis twice: it gives the reaction to the nearer vertex, which
// leaves a torque; and it turns each outer vertex about the hinge by itself, which on quads that are not rectangles is
// no gradient and makes energy out of nothing (for triangles and rectangles it is the same). θ is 0 for a flat pair, its
// sign follows from normals that agree across the hinge, and its difference from rest lies in (−π, π].
#pragma once

#include "sim/mechanics/law.h"

#include <array>
#include <memory>

namespace rend {

// Of each side: A, B, outer near A, outer near B. A and B are the same for both: what a side does to them is kept
// apart, for it is the force of that side's element.
using HingePoints = std::array<Vec3, 8>;

// θ in (−π, π]. A side without area, or a hinge without length, gives 0.
double hinge_angle(const HingePoints& x);

// ∂θ/∂x of the eight. Where P of a side is on the hinge line, or the hinge has no length, nothing turns: all zero.
HingePoints hinge_gradient(const HingePoints& x);

double hinge_moment(const UnitParameters& p, const HingePoints& x, const HingePoints& v); // kθ + λθ̇ [N·m]
HingePoints hinge_forces(const UnitParameters& p, const HingePoints& x, const HingePoints& v);
double hinge_energy(const UnitParameters& p, const HingePoints& x); // [J], the potential of the force

const std::shared_ptr<const Law>& hinge_law(); // 8 particles; k, damping, rest angle

} // namespace rend
