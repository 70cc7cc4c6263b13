// Rigid body motions: which of them the prescribed coordinates (Dirichlet conditions) leave free.
//
// The connected components of the stiffness pattern are treated one by one. A translation along an axis without
// prescribed coordinates meets no resistance in any state: there is no equilibrium, or it is not unique.
// Rotations are different, since a pendulum has an equilibrium.
//
// All that is so for forces between particles. A component is *anchored* where internal forces act against the
// ground instead, as springs from its vertices to their places at rest do; the solve itself finds whether these
// suffice.
#pragma once

#include "sim/integrate/integrator.h"
#include "sim/solve/vectors.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace rend {

// One mask of axes per vertex slot, bits 0, 1, 2 for x, y, z, as in System::mark_prescribed. `inverse_mass` 0:
// free slot.
using AxisMasks = std::vector<std::uint8_t>;

// The axes along which each component is anchored, at all of its vertices; empty where none is. By the tangent:
// stiffnesses of forces between particles sum up to 0 over a component.
AxisMasks anchored_axes(const double* inverse_mass, const BlockMatrix& tangent);

// The free translations of the first component that has some ("along x and z ..."); nullopt: none.
std::optional<std::string> free_translation_of(const BlockPattern& pattern, const double* inverse_mass,
                                               const AxisMasks& held, const AxisMasks& anchored);

// Whether some component that is not anchored can rotate as a rigid body, from the current positions.
bool can_rotate(const BlockPattern& pattern, const double* inverse_mass, const AxisMasks& held,
                const AxisMasks& anchored, const Record* position);

// For components that were torn off: constrains as many coordinates of each component that can translate (or
// rotate, unless its forces are invariant under rotation, `turns`, or it is anchored) as make its rigid motions
// determinate without restricting its shape, and marks its vertices. Without loads the reactions there are 0.
void constrain_detached(const BlockPattern& pattern, const double* inverse_mass, const Record* position,
                        bool turns, const AxisMasks& anchored, AxisMasks& held,
                        std::vector<std::uint8_t>& detached);

// Whether the internal forces on components that are not anchored are rotation invariant, measured at quarter
// turns about z and x, which are exact in floating point. `size`: extent() of the body [m]; `tangent`: the
// semi-definite one at `position`; `room` is overwritten.
using RotationScratch = std::array<Records, 4>; // one record per vertex slot each
bool is_rotation_invariant(System& system, double time, const Records& position, double size,
                           const BlockMatrix& tangent, const AxisMasks& anchored, RotationScratch& room);

// The boundary conditions of a static solve.
struct SupportState {
  AxisMasks held;                     // constrained axes
  AxisMasks anchored;                 // known where a component could move otherwise; empty: none is
  std::vector<std::uint8_t> detached; // 1: of a component that was torn off, without loads; one per vertex slot
  bool found_equilibrium = false;     // an equilibrium has been found before
  bool constrains_rotations = false;  // components that can rotate are treated as torn off
  RotationScratch room;               // scratch; empty until a component can rotate

  // With `held` as set by the system: constrains and marks the components that were torn off since the last
  // equilibrium, and refuses (NotConverged) a body that can translate or rotate without resistance. Position
  // and size as above; `still`: velocities of 0; the matrix is overwritten.
  void check(System& system, double time, const Records& position, const Records& still, double size,
             BlockMatrix& matrix);
};

double stiffness_of(const Block3& diagonal); // the largest diagonal entry [N/m]

// The longest side of the bounding box of all vertices [m].
double extent(const Records& position, const double* inverse_mass);

// [1/s²]: the trace of the matrix divided by that of the masses. inverse_mass: [1/kg], one per vertex slot, 0:
// free slot.
double mean_stiffness(const BlockMatrix& matrix, const double* inverse_mass, std::size_t count);

} // namespace rend
