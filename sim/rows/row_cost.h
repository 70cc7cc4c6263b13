// The minimal cost of one evaluation of a row: bytes of memory traffic, and operations.
//
// Bytes: the row's values and indices, and its share of its particles' data, each record once per evaluation:
// positions, with damping velocities, and forces, which are read and written. Reads that hit the caches are not
// counted.
//
// Operations: additions, subtractions, multiplications, divisions and square roots of forces(), as counted in
// the source of the law's kernel; fourth components, signs, comparisons and selections are not counted. The
// polar rotation is assumed to need three iterations, as for strains of some percent (rotation_lanes.h).
#pragma once

#include "sim/rows/binder.h"

#include <optional>

namespace rend {

struct RowCost {
  double read = 0, written = 0;     // [byte] per row
  std::optional<double> operations; // per row; nullopt: not known for the law's kernel
};

// With `corners`, forces go to element corners. Visits all rows once.
RowCost cost_of(const Binder& binder, bool corners);

std::optional<double> operations_of(const ForceLaw& law, bool damped);

} // namespace rend
