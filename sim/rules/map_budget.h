// How large rules may make a map.
//
//   darts   16,777,216: two million quads, 350,000 hexahedra
//   bytes   4 GiB, of what these darts take while rules make them: a part that is the same for all, a further
//           one where values are inherited, and the values on their orbits. Of an elastic sheet in a run these
//           are a million triangles
//
// It goes by counts alone, not by the memory of the moment, so that a preset is refused, or a law waits, on
// every machine alike and in every run. A map that is larger already, from a mesh file, may be changed by rules
// that do not let it grow.
#pragma once

#include <cstddef>

namespace rend {

class EmbeddedMap;

struct MapBudget {
  std::size_t darts = std::size_t{1} << 24U;
  std::size_t bytes = std::size_t{1} << 32U;
};

// The number of darts that this map may have: as many as its budget names, or as fill its bytes.
std::size_t most_darts(const EmbeddedMap& map, const MapBudget& budget = {});

// Of a change that would make more, in words that are the same wherever it would.
inline constexpr const char* beyond_budget = "the body would grow beyond what rules may make of it";

} // namespace rend
