// How far one trajectory is from another.
//
// With m_i the mass of point i and Δx_i(t) its distance from where the reference has it,
//
//   L2(t) = √( Σ m_i |Δx_i|² / Σ m_i )        L∞(t) = max_i |Δx_i|
//   over time: √( mean over the samples after the start of L2² ),  and the maximum of L∞
//
// and velocities alike. Made relative by the reference's own motion, so that 0.01 is one per cent of it
// whatever the scene: lengths by the largest root mean square displacement from the start, speeds by the
// largest root mean square speed, energies by the largest kinetic energy. Energy drift is the change of the
// energy since the start, less what it is in the reference (nothing where nothing dissipates or drives).
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
  double energy = 0;                       // [J], the largest drift by size
  std::optional<double> momentum, angular; // largest drifts by size, where nothing acts from outside
  std::size_t samples = 0;                 // compared
};

// What makes errors relative; 1 where the reference does not move.
struct Scales {
  double length = 1, speed = 1, energy = 1; // [m], [m/s], [J]
  double mass = 0;                          // [kg]
};
Scales scales_of(const Trajectory& reference);

// Over the samples that both have, up to `until` [s]: trajectories part after a tear. Points are matched by
// their rest positions where the meshes differ. None: there is no such sample or no common point.
std::optional<StateErrors> compare(const Trajectory& run, const Trajectory& reference,
                                   double until = std::numeric_limits<double>::infinity());

// |A ∩ B| / |A ∪ B| (Jaccard 1901); 1 where both are empty.
double overlap(const std::vector<TornSide>& a, const std::vector<TornSide>& b);

} // namespace rend
