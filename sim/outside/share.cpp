#include "sim/outside/share.h"

#include "sim/mechanics/mass.h"
#include "sim/topology/orientation.h"
#include "sim/topology/walk.h"

namespace rend {

double Share::inherit(const EmbeddedMap& map, Dart d, std::span<const Inherited<double>> parents) const {
  if (inheritance == Inheritance::Share) return sum_of(parents);
  for (const Inherited<double>& parent : parents)
    if (parent.value == 0) return 0;
  const Inherited<double>& parent = parents.front();
  return orbit == FaceOfVolume && !turns_alike(map.map(), parent.dart, d) ? -parent.value : parent.value;
}

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
