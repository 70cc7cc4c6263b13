// Sorts by dart in linear time: after an edit that touched very many orbits, a comparison sort would dominate
// the cost.
#pragma once

#include <cstdint>
#include <vector>

namespace rend {

// Each key has a dart in its upper 32 bits, all different, and any payload in its lower bits.
void sort_by_dart(std::vector<std::uint64_t>& keys);

} // namespace rend
