#include "sim/rules/map_budget.h"

#include "sim/embedding/embedded_map.h"

#include <algorithm>

namespace rend {
namespace {

// Measured, of sheets and of solids: links, what an edit records of a new dart until it closes, and the copies
// that ordering a finished body takes.
constexpr std::size_t bytes_of_dart = 192;

// Where values are inherited, as masses are in a run: whose heir the dart is.
constexpr std::size_t bytes_of_heir = 384;

// A value lies in the embedding, and once more in the rows that kernels run over.
constexpr std::size_t copies_of_values = 2;

std::size_t bytes_per_dart(const EmbeddedMap& map) {
  std::size_t slots = 0, values = 0;
  bool inherits = false;
  for (int mask = 0; mask < orbit_kinds; ++mask) {
    Orbit orbit;
    orbit.mask = static_cast<std::uint8_t>(mask);
    if (map.uses(orbit)) slots += sizeof(Slot);
  }
  for (const auto& column : map.columns()) {
    values += column->bytes();
    inherits = inherits || column->inheritance();
  }
  const std::size_t darts = std::max<std::size_t>(map.map().capacity(), 1);
  return bytes_of_dart + (inherits ? bytes_of_heir : 0) + slots + copies_of_values * values / darts;
}

} // namespace

std::size_t most_darts(const EmbeddedMap& map, const MapBudget& budget) {
  return std::min(budget.darts, budget.bytes / bytes_per_dart(map));
}

} // namespace rend
