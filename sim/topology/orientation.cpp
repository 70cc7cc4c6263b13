#include "sim/topology/orientation.h"

#include "sim/topology/index_set.h"

namespace rend {

Sides sides_of(const GMap& map) {
  Sides sides{std::vector<std::uint8_t>(map.capacity(), 0)};
  std::vector<Dart> stack;
  map.for_each_dart([&](Dart first) {
    if (sides.of_dart[first.value] != 0) return;
    sides.of_dart[first.value] = 1;
    stack.assign(1, first);
    while (!stack.empty()) {
      const Dart d = stack.back();
      stack.pop_back();
      for (int i = 0; i < 4; ++i) {
        const Dart next = map.alpha(i, d);
        if (next == d) continue;
        std::uint8_t& side = sides.of_dart[next.value];
        if (side == sides.of_dart[d.value]) sides.orientable = false;
        if (side != 0) continue;
        side = static_cast<std::uint8_t>(3 - sides.of_dart[d.value]);
        stack.push_back(next);
      }
    }
  });
  return sides;
}

bool turns_alike(const GMap& map, Dart a, Dart b) {
  if (!map.alive(a)) return true;
  thread_local IndexMap steps; // to each dart that was reached
  std::vector<Dart> reached{a};
  steps.clear();
  steps.insert(a.value, 0);
  for (std::size_t at = 0; at < reached.size(); ++at) {
    const std::uint32_t so_far = steps.find(reached[at].value);
    if (reached[at] == b) return so_far % 2 == 0;
    for (int i = 0; i < 4; ++i) {
      const Dart next = map.alpha(i, reached[at]);
      if (steps.find(next.value) != IndexMap::none) continue;
      steps.insert(next.value, so_far + 1);
      reached.push_back(next);
    }
  }
  return true;
}

} // namespace rend
