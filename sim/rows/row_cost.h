// What one evaluation of a row costs at least: bytes to and from memory, and operations.
//
// Bytes: what the row carries (numbers and indices), and its share of what its particles need, each record once
// an evaluation: positions, with damping velocities, and forces, which are read and written. What is read again
// from the caches does not count.
//
// Operations: additions, subtractions, multiplications, divisions and roots of forces(), as the kernel of the
// law does them, counted in its source; fourth components, signs, comparisons and choices do not count. The
// polar rotation is taken to need three iterations, which is what strains of some percent take
// (rotation_lanes.h).
#pragma once

#include "sim/rows/binder.h"

#include <optional>

namespace rend {

struct RowCost {
  double read = 0, written = 0;     // [byte] a row
  std::optional<double> operations; // a row; none: the law's kernel states none
};

// With `corners`, forces go to element corners. Goes through all rows once.
RowCost cost_of(const Binder& binder, bool corners);

std::optional<double> operations_of(const ForceLaw& law, bool damped);

} // namespace rend
