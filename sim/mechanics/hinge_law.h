// The angular spring of a hinge A→B between two faces (thesis 6.3.2, fig. 6.23, eq. 6.2).
//
// Each side has two outer vertices, the far ends of the edges next to the hinge (the same vertex, twice, on a
// triangle), and P between them. With u the unit vector of AB, d = |u × AP| the distance of P from the hinge
// line, and θ the dihedral angle of the triangles ABP, the moment kθ + λθ̇ of the difference from rest acts on
// P, half on each of the two, by the force
//
//   ± (moment/d) (u × AP)/d
//
// and on A and B, as ends of its own side, by the opposite in the proportions 1 − t and t of P's projection on
// AB. It is −∇(½kθ²) for every shape of cell. Corrected against the thesis twice: it gives the reaction to the
// nearer vertex, which leaves a torque; and it turns each outer vertex about the hinge by itself, which on
// quads that are not rectangles is no gradient and makes energy out of nothing (for triangles and rectangles it
// is the same). θ is 0 for a flat pair, its sign follows from normals that agree across the hinge, and its
// difference from rest lies in (−π, π].
//
// The closer P comes to the hinge line, the larger is 1/d, and without end: a triangle that is crushed to no
// area would be thrown apart by forces that no step resolves, in a direction that changes sides as P crosses
// the line. The angle has no meaning there. So the gradient of θ is faded where a side's area is below 1/8 of
// that at rest:
//
//   g = φ₁ φ₂ ∂θ/∂x,   φ_i = min(1, |n_i|²/least),   n_i = AB × AP_i
//   least = (|n|/8)² of the smaller side at rest
//   force = −g (kθ + λ g·v)
//
// Bounded, since |∂θ/∂x| ≤ (|AB| + |AP|)/|n|; it passes through 0 where the angle jumps; above that area
// nothing changes, to the bit. One factor for both sides, as the moments of both must cancel: momentum and
// angular momentum stay. Damping still dissipates. While it fades, the force is no gradient. (That of a faded
// potential would be one, and pull crushed triangles together, stiffer than all of the hinge at rest.) The
// energy φ₁ φ₂ ½kθ² has no jump.
#pragma once

#include "sim/mechanics/force_law.h"

#include <array>
#include <memory>

namespace rend {

// Of each side: A, B, outer near A, outer near B. A and B are the same for both: what a side does to them is
// kept apart, for it is the force of that side's element.
using HingePoints = std::array<Vec3, 8>;

struct HingeParameters {
  double k = 0;       // [N·m/rad]
  double damping = 0; // [N·m·s/rad]
  double rest = 0;    // [rad]
  double least = 0;   // [m⁴], of |n|² in a side that is not crushed; 0: never

  static HingeParameters of(const double* unit) { return {unit[0], unit[1], unit[2], unit[3]}; }
};
static_assert(sizeof(HingeParameters) == 4 * sizeof(double));

double hinge_least(const HingePoints& rest); // of the parameters, from positions at rest

// θ in (−π, π]. A side without area, or a hinge without length, gives 0.
double hinge_angle(const HingePoints& x);

// ∂θ/∂x of the eight. Where P of a side is on the hinge line, or the hinge has no length, nothing turns: all
// zero.
HingePoints hinge_gradient(const HingePoints& x);

double hinge_moment(const HingeParameters& p, const HingePoints& x, const HingePoints& v); // φ(kθ + λφθ̇) [N·m]
HingePoints hinge_forces(const HingeParameters& p, const HingePoints& x, const HingePoints& v);
double hinge_energy(const HingeParameters& p, const HingePoints& x); // [J]

const std::shared_ptr<const ForceLaw>& hinge_law(); // 8 particles; HingeParameters

} // namespace rend
