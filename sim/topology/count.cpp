#include "sim/topology/count.h"

#include "sim/topology/walk.h"

namespace rend {
namespace {

// Labels the orbits of every dart by increasing smallest dart; returns how many there are.
std::uint32_t label(const GMap& map, Orbit orbit, std::vector<std::uint32_t>& labels) {
  labels.assign(map.capacity(), Dart::none_value);
  std::uint32_t count = 0;
  std::vector<Dart> stack;
  map.for_each_dart([&](Dart first) {
    if (labels[first.value] != Dart::none_value) return;
    labels[first.value] = count;
    stack.assign(1, first);
    while (!stack.empty()) {
      const Dart d = stack.back();
      stack.pop_back();
      for (int i = 0; i < 4; ++i) {
        if (!orbit.has(i)) continue;
        const Dart next = map.alpha(i, d);
        if (labels[next.value] != Dart::none_value) continue;
        labels[next.value] = count;
        stack.push_back(next);
      }
    }
    ++count;
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
