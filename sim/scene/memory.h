// The memory of a scene, array by array.
//
// Arrays count with what was written to them (base/bytes.h); objects of fixed size, names and the preset are
// not counted: some kilobytes. Arrays allocated by the first step are included after it. A test compares the
// sum with the growth of the heap.
#pragma once

#include "sim/scene/scene.h"

#include <string>
#include <vector>

namespace rend {

struct MemoryEntry {
  std::string part; // one of footprint_parts()
  std::string name; // of the array, in plain language
  std::string per;  // what it has one entry for ("vertex"); empty: a list of its own length
  std::size_t bytes = 0;
};

// map, slots, embeddings, program, laws, solver, integrator, state, constraints, loads, contact, guard.
const std::vector<std::string>& footprint_parts();

// Without empty arrays. Of a body, and of what the bodies of a scene share.
std::vector<MemoryEntry> footprint_of(const Body& body);
std::vector<MemoryEntry> footprint_of(const Scene& scene);

std::size_t bytes_of_part(const std::vector<MemoryEntry>& all, const std::string& part);
std::size_t bytes_of_all(const Scene& scene);

} // namespace rend
