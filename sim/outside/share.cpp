#include "sim/outside/share.h"

#include "sim/mechanics/mass.h"
#include "sim/topology/walk.h"

namespace rend {

ShareColumn& share_equally(EmbeddedMap& map, const std::string& name, const std::vector<Slot>& vertices) {
  const Orbit corner = corner_orbit(map.dimension());
  const CellIndex& corners = map.use(corner);
  ShareColumn& shares = map.add(Share{name, corner});
  for (Slot v : vertices) {
    std::vector<Dart> darts = darts_of(map.map(), Vertex, map.cells(Vertex).first_dart(v));
    std::erase_if(darts, [&](Dart d) { return corners.first_dart(corners.slot(d)) != d; });
    for (Dart d : darts)
      shares[corners.slot(d)] = 1 / static_cast<double>(vertices.size()) / static_cast<double>(darts.size());
  }
  return shares;
}

} // namespace rend
