// Restores the order of slots in memory.
//
// Slots are numbered in the order of smallest darts, so that the data of neighbouring elements lie close in
// memory. A fragment that splits off takes a new slot at the end, so after many edits the vertices of a
// crumbled body are scattered until EmbeddedMap::number_anew(). (200,000 co-rotational tetrahedra with a third
// of their faces separated in 760 edits: forces took 8.8 ms before and 5.3 ms after renumbering, which took 10
// ms, and 0.17 s with rebinding: paid back in 50 steps.)
#pragma once

#include "sim/embedding/embedded_map.h"

namespace rend {

// Whether the slots of a third of the vertices are out of order: between a slot and the next lie more than 32
// times as many darts as on average. Right after numbering this holds for at most one in 32, so the number of
// vertices must grow by half before it becomes true again. A function of the map alone; false below `least`
// vertices, whose state fits into a cache.
bool slots_scattered(const EmbeddedMap& map, std::size_t least = 8192);

} // namespace rend
