// Rigid body motions: which of them the prescribed coordinates (Dirichlet conditions) leave free.
//
// The connected components of the stiffness pattern are treated one by one. A translation along an axis without
// prescribed coordinates meets no resistance in any state: there is no equilibrium, or it is not unique.
// Rotations are different, since a pendulum has an equilibrium.
#pragma once

#include "sim/integrate/integrator.h"
#include "sim/solve/vectors.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace rend {

// The free translations of the first component that has some ("along x and z ..."); nullopt: none. `held`: as
// in System::hold; `inverse_mass` 0: free slot.
std::optional<std::string> free_translation_of(const BlockPattern& pattern, const double* inverse_mass,
                                               const std::vector<std::uint8_t>& held);

// Whether some component can rotate as a rigid body, from the current positions.
bool can_rotate(const BlockPattern& pattern, const double* inverse_mass, const std::vector<std::uint8_t>& held,
                const Record* position);

// For components that were torn off: constrains as many coordinates of each component that can translate (or
// rotate, unless its forces are invariant under rotation, `turns`) as make its rigid motions determinate
// without restricting its shape, and marks its vertices. Without loads the reactions there are 0. `loose`: one
// per vertex slot.
void constrain_detached(const BlockPattern& pattern, const double* inverse_mass, const Record* position,
                        bool turns, std::vector<std::uint8_t>& held, std::vector<std::uint8_t>& detached);

// Whether the internal forces are rotation invariant, measured at quarter turns about z and x, which are exact
// in floating point. `size`: extent() of the body [m]; the matrix and `room` are overwritten.
using RotationScratch = std::array<Records, 4>; // one record per vertex slot each
bool is_rotation_invariant(System& system, double time, const Records& position, double size,
                           BlockMatrix& matrix, RotationScratch& room);

// The boundary conditions of a static solve.
struct SupportState {
  std::vector<std::uint8_t> held;     // constrained axes, one per vertex slot
  std::vector<std::uint8_t> detached; // 1: of a component that was torn off, without loads; one per vertex slot
  bool found_equilibrium = false;     // an equilibrium has been found before
  bool constrains_rotations = false;  // components that can rotate are treated as torn off
  RotationScratch room;               // scratch; empty until a component can rotate

  // With `held` as set by the system: constrains and marks the components that were torn off since the last
  // equilibrium, and refuses (NotConverged) a body that can translate or rotate without resistance. Position
  // and size as above; the matrix is overwritten.
  void check(System& system, double time, const Records& position, double size, BlockMatrix& matrix);
};

double stiffness_of(const Block3& diagonal); // the largest diagonal entry [N/m]

// The longest side of the bounding box of all vertices [m].
double extent(const Records& position, const double* inverse_mass);

// [1/s²]: the trace of the matrix divided by that of the masses. inverse_mass: [1/kg], one per vertex slot, 0:
// free slot.
double mean_stiffness(const BlockMatrix& matrix, const double* inverse_mass, std::size_t count);

} // namespace rend
