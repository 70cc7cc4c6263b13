// Sorts by darts in linear time: where an edit touched very many orbits, a comparing sort would cost more than
// all else.
#pragma once

#include <cstdint>
#include <vector>

namespace rend {

// Each key is a dart in its upper 32 bits, all different, and anything in its lower.
void sort_by_dart(std::vector<std::uint64_t>& keys);

} // namespace rend
