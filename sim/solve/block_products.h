// Products of 3 × 3 blocks for the factorisation.
#pragma once

#include "sim/rows/block_matrix.h"

namespace rend {

// a −= b cᵀ
REND_INLINE void subtract_product(Block3& a, const Block3& b, const Block3& c) {
  const Double4 b0 = load(b.column[0]), b1 = load(b.column[1]), b2 = load(b.column[2]);
  const Record &c0 = c.column[0], &c1 = c.column[1], &c2 = c.column[2];
  store(a.column[0], load(a.column[0]) - (b0 * splat(c0.x) + b1 * splat(c1.x) + b2 * splat(c2.x)));
  store(a.column[1], load(a.column[1]) - (b0 * splat(c0.y) + b1 * splat(c1.y) + b2 * splat(c2.y)));
  store(a.column[2], load(a.column[2]) - (b0 * splat(c0.z) + b1 * splat(c1.z) + b2 * splat(c2.z)));
}

} // namespace rend
