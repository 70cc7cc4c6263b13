// What holds a body: which motions of its pieces as rigid bodies the prescribed coordinates leave.
//
// A piece is what the pattern of the stiffness joins. Moved as a whole along an axis none of whose coordinates
// is prescribed, it meets no resistance in any state: there is no equilibrium to be found, or not one alone.
// Turns are another matter, since a pendulum has an equilibrium.
#pragma once

#include "sim/integrate/integrator.h"
#include "sim/solve/vectors.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace rend {

// What is left free of the first piece that can move off as a whole ("along x and z ..."); empty: none.
// `held`: as System::hold; `inverse_mass` 0: free slot.
std::optional<std::string> drift_of(const BlockPattern& pattern, const double* inverse_mass,
                                    const std::vector<std::uint8_t>& held);

// Whether some piece can turn as a whole, from the present positions.
bool can_turn(const BlockPattern& pattern, const double* inverse_mass, const std::vector<std::uint8_t>& held,
              const Record* position);

// For pieces that came off: holds as many coordinates of each piece that can move off as a whole (or turn,
// where nothing `turns` with the body) as keep it in its place and leave it to take its own shape, and marks
// its vertices. Without loads those coordinates carry nothing. `loose`: one per vertex slot.
void pin_loose(const BlockPattern& pattern, const double* inverse_mass, const Record* position, bool turns,
               std::vector<std::uint8_t>& held, std::vector<std::uint8_t>& loose);

// Whether forces turn with the body, measured at quarter turns about z and x, which are exact in coordinates.
// `size`: its extent() [m]; the matrix and `room` are written.
using TurningRoom = std::array<Records, 4>; // one record per vertex slot each
bool turns_with_body(System& system, double time, const Records& position, double size, BlockMatrix& matrix,
                     TurningRoom& room);

// What a static solve knows of how its body is held.
struct Footing {
  std::vector<std::uint8_t> held;  // axes, one per vertex slot
  std::vector<std::uint8_t> loose; // 1: of a piece that came off, without loads; one per vertex slot
  bool stood = false;              // in equilibrium, once
  bool keeps_turned = false;       // what can turn is loose
  TurningRoom room;                // scratch; empty until something can turn

  // With `held` as the system has it: holds and marks what came off since the body stood, and refuses
  // (Unsolved) a body that can move off or turn without resistance. Position and size as above; the matrix is
  // written.
  void check(System& system, double time, const Records& position, double size, BlockMatrix& matrix);
};

double stiffness_of(const Block3& diagonal); // the largest diagonal entry [N/m]

// The longest side of the box around all vertices [m].
double extent(const Records& position, const double* inverse_mass);

// [1/s²]: the mean of the diagonal for each unit of mass. inverse_mass: [1/kg], one per vertex slot, 0: free
// slot.
double mean_stiffness(const BlockMatrix& matrix, const double* inverse_mass, std::size_t count);

} // namespace rend
