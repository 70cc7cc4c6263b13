#include "sim/embedding/reorder.h"

namespace rend {

bool slots_scattered(const EmbeddedMap& map, std::size_t least) {
  const CellIndex& vertices = map.cells(Vertex);
  if (vertices.count() < least) return false;
  const std::uint64_t far = 32 * std::uint64_t{map.map().capacity()} / vertices.count();
  std::size_t scattered = 0;
  std::uint32_t last = 0;
  for (Slot v = 0; v < vertices.slots(); ++v) {
    if (!vertices.alive(v)) continue;
    const std::uint32_t dart = vertices.first_dart(v).value;
    scattered += (dart > last ? dart - last : last - dart) > far;
    last = dart;
  }
  return 3 * scattered > vertices.count();
}

} // namespace rend
