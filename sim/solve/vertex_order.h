// An ordering of the rows of a pattern with a small bandwidth (reverse Cuthill & McKee 1969, from a
// pseudo-peripheral row of each component as in George & Liu 1979): what a row reads is still in the caches,
// and incomplete factors drop less.
#pragma once

#include "sim/rows/block_matrix.h"

namespace rend {

std::vector<std::uint32_t> vertex_order(const BlockPattern& pattern); // row at each position; a permutation

} // namespace rend
