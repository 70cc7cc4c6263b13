// A bound of the highest eigenfrequency of a body, which limits the step of explicit schemes.
//
// Each unit bounds its contribution to the stiffness of its particles by a diagonal (ForceLaw::bound:
// Gershgorin discs, or an element's largest eigenvalue). The diagonals are summed at each element corner and
// divided by the corner's mass; the maximum bounds the whole body (Irons: no eigenvalue of an assembly exceeds
// the largest of its elements), and no separation changes it, since a separation changes no corner.
//
// A separation divides some owners, such as a Vertex, and each fragment takes over the whole unit, from its own
// smallest dart. Such a unit therefore counts in full at each element corner of the owner: then the bound holds
// before and after, however light a fragment is. Until something is separated a lower one holds
// (vertex_bounds.h).
#pragma once

#include "sim/mechanics/interaction.h"
#include "sim/mechanics/mass.h"

#include <span>

namespace rend {

struct FrequencyBounds {
  double omega_squared = 0;   // [1/s²], bound of the highest frequency, at rest
  double damping_rate = 0;    // [1/s], bound over all modes
  double least_drag_rate = 0; // [1/s], the smallest rate of ambient viscosity alone
};

// The diagonals, summed at each element corner: one per corner slot.
struct CornerBounds {
  std::vector<double> stiffness, damping; // [N/m], [N·s/m]
};
CornerBounds corner_bounds(const EmbeddedMap& map, std::span<const Interaction* const> interactions,
                           const MassColumn& mass);
CornerBounds corner_bounds(const EmbeddedMap& map,
                           const std::vector<std::unique_ptr<Interaction>>& interactions,
                           const MassColumn& mass);

// Whatever is separated.
FrequencyBounds frequency_bounds(const CornerBounds& bounds, const EmbeddedMap& map, const MassColumn& mass,
                                 const DragColumn* drag);
inline FrequencyBounds frequency_bounds(const EmbeddedMap& map,
                                        const std::vector<std::unique_ptr<Interaction>>& interactions,
                                        const MassColumn& mass, const DragColumn* drag) {
  return frequency_bounds(corner_bounds(map, interactions, mass), map, mass, drag);
}

} // namespace rend
