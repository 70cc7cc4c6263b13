// Selective mass scaling: the elements that limit the step of an explicit scheme are made heavier, as
// <time mass-scaling="0.01"> allows.
//
// A mesh from the real world has a few slivers, whose frequencies are many times those of all other elements.
// An element of mass m and step h(m) (element_steps.h) whose step is below the target H is given the mass
// f m, with the least f for which h(f m) ≥ H: without damping f = (H/h)². Its corners share what is added, so
// that the vertices around it are heavier, and no element outside it is touched. H is the largest for which
// no body gains more than the given share of its mass, found by bisection; where the step is given, H is at
// most that. The step that is taken follows from the masses as they are then: it is stable, whatever H was.
//
// (Belytschko, Liu, Moran & Elkhodary, Nonlinear Finite Elements, 6.2; DT2MS of LS-DYNA is the same. Olovsson,
// Simonsson & Unosson 2005 keep the rigid motions of an element as they were, by masses that are not diagonal.)
//
// Inertia and weight change: the added mass is real in all that follows. Momentum, energies and fragments count
// it, gravity pulls it. A mode φ becomes slower by ½ φᵀ ΔM φ/φᵀ M φ: by half the share, if what is added were
// spread evenly; by more, if it moves mostly there, and so may a fragment that is torn off around slivers.
#pragma once

#include "sim/body/body.h"

namespace rend {

// Changes the corner masses of bodies that are not prepared yet, sets Body::added_mass, and says in their notes
// how much it was. `most`: share of a body's mass; `wanted` [s]: the step, if it is given. False: nothing was
// changed, since the step would be larger by less than a twentieth.
bool scale_masses(const std::vector<std::unique_ptr<Body>>& bodies, const Scheme& scheme, double most,
                  std::optional<double> wanted);

} // namespace rend
