#include "sim/embedding/reorder.h"

#include "sim/base/archive.h"

#include <array>
#include <cstring>
#include <memory>

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

void number_anew(EmbeddedMap& map) {
  std::array<std::unique_ptr<CellIndex>, orbit_kinds> fresh;
  Archive out; // as EmbeddedMap::store() reads it
  out.bytes().reserve(map.map().bytes() + map.bytes());
  out.mark("map");
  GMap(map.map()).store(out);
  for (std::size_t mask = 0; mask < fresh.size(); ++mask) {
    Orbit orbit;
    orbit.mask = static_cast<std::uint8_t>(mask);
    out.same(map.uses(orbit) ? 1 : 0, "whether orbits have slots");
    if (!map.uses(orbit)) continue;
    fresh[mask] = std::make_unique<CellIndex>(map.map(), orbit);
    fresh[mask]->store(out);
  }
  out.same(map.columns().size(), "number of embeddings");
  for (const auto& column : map.columns()) {
    const CellIndex &old = map.cells(column->orbit()), &now = *fresh[column->orbit().mask];
    const std::span<std::byte> values = column->raw();
    const std::size_t size = old.slots() > 0 ? values.size() / old.slots() : 0;
    out.mark(column->name());
    out.same(now.slots() * size, "bytes of an embedding");
    for (Slot s = 0; s < now.slots(); ++s) out.raw(values.data() + old.slot(now.first_dart(s)) * size, size);
  }
  Archive in{std::span<const std::uint8_t>(out.bytes())};
  map.store(in);
}

} // namespace rend
