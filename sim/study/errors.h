// Distances between trajectories.
//
// With m_i the mass of point i and Δx_i(t) its distance from its position in the reference,
//
//   L2(t) = √( Σ m_i |Δx_i|² / Σ m_i )        L∞(t) = max_i |Δx_i|
//   over time: √( mean over the samples after the start of L2² ),  and the maximum of L∞
//
// and likewise for velocities. Relative errors are scaled by the reference's own motion, so that 0.01 is one
// per cent of it in every scene: lengths by the largest root mean square displacement from the start, speeds by
// the largest root mean square speed, energies by the largest kinetic energy. Energy drift is the change of the
// energy since the start minus that of the reference (0 if nothing dissipates or drives).
#pragma once

#include "sim/study/trajectory.h"

namespace rend {

struct Norms {
  double over_time = 0, final = 0;         // L2
  double over_time_max = 0, final_max = 0; // L∞
};

struct StateErrors {
  Norms position;                          // [m]
  Norms velocity;                          // [m/s]
  double energy = 0;                       // [J], the largest drift in magnitude
  std::optional<double> momentum, angular; // largest drifts in magnitude, if there are no external forces
  std::size_t samples = 0;                 // number compared
};

// The scales of relative errors; 1 if the reference does not move.
struct Scales {
  double length = 1, speed = 1, energy = 1; // [m], [m/s], [J]
  double mass = 0;                          // [kg]
};
Scales scales_of(const Trajectory& reference);

// Over the samples that both have, up to `until` [s]: trajectories diverge after a tear. Points are matched by
// their rest positions if the meshes differ. nullopt: no such sample or no common point.
std::optional<StateErrors> compare(const Trajectory& run, const Trajectory& reference,
                                   double until = std::numeric_limits<double>::infinity());

// |A ∩ B| / |A ∪ B| (Jaccard 1901); 1 if both are empty.
double overlap(const std::vector<TornSide>& a, const std::vector<TornSide>& b);

} // namespace rend
