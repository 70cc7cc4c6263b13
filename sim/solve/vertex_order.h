// An order of the rows of a pattern in which neighbours stand near each other (reverse Cuthill & McKee 1969,
// from an end of each piece as George & Liu 1979 find it): what a row reads is still in the caches, and
// incomplete factors leave out less.
#pragma once

#include "sim/rows/block_matrix.h"

namespace rend {

std::vector<std::uint32_t> vertex_order(const BlockPattern& pattern); // row at each place; a permutation

} // namespace rend
