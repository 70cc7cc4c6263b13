// How fast a body can swing at most: what limits the step of an explicit scheme.
//
// Each unit bounds what it adds to the stiffness of its particles by a diagonal (ForceLaw::bound: Gershgorin's
// discs, an element's largest eigenvalue). Summed over each element corner by itself and divided by the
// corner's mass, the largest is a bound for the whole (Irons: no assembly swings faster than its fastest
// element), and no separation changes it, since a separation changes no corner.
#pragma once

#include "sim/mechanics/interaction.h"
#include "sim/mechanics/mass.h"

namespace rend {

struct FrequencyBounds {
  double omega_squared = 0;   // [1/s²], of the highest frequency at rest
  double damping_rate = 0;    // [1/s], the largest of all modes
  double least_drag_rate = 0; // [1/s], the smallest, of ambient viscosity alone
};

FrequencyBounds frequency_bounds(const EmbeddedMap& map,
                                 const std::vector<std::unique_ptr<Interaction>>& interactions,
                                 const MassColumn& mass, const DragColumn* drag);

} // namespace rend
