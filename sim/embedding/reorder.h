// Slots in the order of darts again.
//
// Slots are given in the order of smallest darts, so that what an element needs lies near what its neighbours
// need. A fragment that splits off takes a new slot at the end: after many edits, vertices of a body that has
// crumbled lie anywhere, until the map is told to number them anew (EmbeddedMap). (200,000 co-rotational
// tetrahedra with a third of their faces let go in 760 edits: forces took 8.8 ms, and 5.3 ms numbered anew.
// That took 10 ms, and 0.17 s with all that is bound to the map, which 50 steps pay back.)
#pragma once

#include "sim/embedding/embedded_map.h"

namespace rend {

// Whether the slots of a third of the vertices are out of order: between a slot and the next more than 32 times
// as many darts lie as in the mean. Right after numbering at most one in 32 is; so it takes half as many new
// vertices as there were before it is so again. A function of the map alone; false below `least` vertices:
// their state fits into a cache.
bool slots_scattered(const EmbeddedMap& map, std::size_t least = 8192);

} // namespace rend
