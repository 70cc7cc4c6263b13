// The angular spring of a hinge A→B between two faces (thesis 6.3.2, fig. 6.23, eq. 6.2).
//
// Each side has two outer vertices, the far ends of the edges next to the hinge (on a triangle the same vertex
// twice), and their midpoint P. With u the unit vector of AB, d = |u × AP| the distance of P from the hinge
// line, and θ the dihedral angle of the triangles ABP, the moment kθ + λθ̇, with θ relative to rest, acts on P,
// half on each of the two outer vertices, by the force
//
//   ± (moment/d) (u × AP)/d
//
// and on A and B, as ends of its own side, by the opposite force in the proportions 1 − t and t of P's
// projection on AB. It is −∇(½kθ²) for cells of any shape. Two corrections to the thesis: it applies the
// reaction to the nearer vertex, which leaves a torque; and it rotates each outer vertex about the hinge
// separately, which for quads that are not rectangles is no gradient and creates energy (for triangles and
// rectangles the two agree). θ is 0 for a flat pair, its sign follows from normals oriented consistently across
// the hinge, and its difference from rest lies in (−π, π].
//
// As P approaches the hinge line, 1/d is unbounded: a triangle that is crushed to no area would be thrown apart
// by forces that no time step resolves, whose direction flips as P crosses the line. The angle has no meaning
// there. So the gradient of θ is faded out where the area of a side is below 1/8 of that at rest:
//
//   g = φ₁ φ₂ ∂θ/∂x,   φ_i = min(1, |n_i|²/least),   n_i = AB × AP_i
//   least = (|n|/8)² of the smaller side at rest
//   force = −g (kθ + λ g·v)
//
// It is bounded, since |∂θ/∂x| ≤ (|AB| + |AP|)/|n|, and passes through 0 where the angle jumps; above that area
// nothing changes, to the bit. Both sides have the same factor, as their moments must cancel: momentum and
// angular momentum are conserved. Damping still dissipates. Where it is faded, the force is no gradient. (The
// gradient of a faded potential would pull crushed triangles together, more stiffly than the whole hinge at
// rest.) The energy φ₁ φ₂ ½kθ² is continuous.
#pragma once

#include "sim/mechanics/force_law.h"

#include <array>
#include <memory>

namespace rend {

// Of each side: A, B, outer vertex near A, outer vertex near B. A and B are the same for both, but the forces
// of each side on them are kept apart, as they belong to that side's element.
using HingePoints = std::array<Vec3, 8>;

struct HingeParameters {
  double k = 0;       // [N·m/rad]
  double damping = 0; // [N·m·s/rad]
  double rest = 0;    // [rad]
  double least = 0;   // [m⁴], |n|² below which the force of a side is faded; 0: never faded

  static HingeParameters of(const double* unit) { return {unit[0], unit[1], unit[2], unit[3]}; }
};
static_assert(sizeof(HingeParameters) == 4 * sizeof(double));

double hinge_fade_threshold(const HingePoints& rest); // the `least` of the parameters, from rest positions

// θ in (−π, π]. 0 for a side without area or a hinge without length.
double hinge_angle(const HingePoints& x);

// ∂θ/∂x of the eight particles. All 0 if P of a side is on the hinge line, or the hinge has no length.
HingePoints hinge_gradient(const HingePoints& x);

double hinge_moment(const HingeParameters& p, const HingePoints& x, const HingePoints& v); // φ(kθ + λφθ̇) [N·m]
HingePoints hinge_forces(const HingeParameters& p, const HingePoints& x, const HingePoints& v);
double hinge_energy(const HingeParameters& p, const HingePoints& x); // [J]

const std::shared_ptr<const ForceLaw>& hinge_law(); // 8 particles; HingeParameters

} // namespace rend
