#include "sim/topology/count.h"

#include <algorithm>

namespace rend {
namespace {

// The smallest dart known to be in the orbit of d; `parent` leads from each dart to one that is not larger.
std::uint32_t smallest(std::vector<std::uint32_t>& parent, std::uint32_t d) {
  while (parent[d] != d) d = parent[d] = parent[parent[d]];
  return d;
}

// Labels the orbits of all darts in order of their smallest darts; returns their number. A union-find in the
// order of darts, since the darts of a cell lie close in memory: a search from dart to dart takes four times as
// long.
std::uint32_t label(const GMap& map, Orbit orbit, std::vector<std::uint32_t>& labels) {
  labels.assign(map.capacity(), Dart::none_value);
  map.for_each_dart([&](Dart d) {
    labels[d.value] = d.value;
    std::uint32_t root = d.value;
    for (int i = 0; i < 4; ++i) {
      if (!orbit.has(i)) continue;
      const std::uint32_t next = map.alpha(i, d).value;
      if (next >= d.value) continue;
      const std::uint32_t other = smallest(labels, next);
      labels[std::max(root, other)] = std::min(root, other);
      root = std::min(root, other);
    }
  });
  std::uint32_t count = 0;
  map.for_each_dart([&](Dart d) {
    const std::uint32_t parent = labels[d.value];
    labels[d.value] = parent == d.value ? count++ : labels[parent];
  });
  return count;
}

} // namespace

std::size_t count_cells(const GMap& map, Orbit orbit) {
  std::vector<std::uint32_t> labels;
  return label(map, orbit, labels);
}

CellCounts count_cells(const GMap& map) {
  CellCounts counts;
  counts.vertices = count_cells(map, Vertex);
  counts.edges = count_cells(map, Edge);
  counts.faces = count_cells(map, Face);
  counts.volumes = map.dimension() == 3 ? count_cells(map, Volume) : 0;
  counts.fragments = count_cells(map, Component);
  counts.euler = static_cast<long>(counts.vertices) - static_cast<long>(counts.edges) +
                 static_cast<long>(counts.faces) - static_cast<long>(counts.volumes);
  return counts;
}

std::vector<std::uint32_t> label_fragments(const GMap& map) {
  std::vector<std::uint32_t> labels;
  label(map, Component, labels);
  return labels;
}

} // namespace rend
