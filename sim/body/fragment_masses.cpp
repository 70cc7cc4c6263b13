#include "sim/body/fragment_masses.h"

#include "sim/topology/count.h"

namespace rend {

std::vector<double> fragment_masses(const EmbeddedMap& map, const MassColumn& mass) {
  const std::vector<std::uint32_t> label = label_fragments(map.map());
  const CellIndex& corners = map.cells(mass.orbit());
  std::vector<double> masses;
  map.map().for_each_dart([&](Dart d) {
    if (label[d.value] >= masses.size()) masses.resize(label[d.value] + 1);
    if (const Slot corner = corners.slot(d); corners.first_dart(corner) == d)
      masses[label[d.value]] += mass[corner];
  });
  return masses;
}

} // namespace rend
