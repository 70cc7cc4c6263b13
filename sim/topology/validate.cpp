#include "sim/topology/validate.h"

#include <fmt/format.h>

namespace rend {
namespace {

std::optional<BrokenAxiom> fault_of_links(const GMap& map, Dart d) {
  for (int i = 0; i < 4; ++i) {
    const Dart e = map.alpha(i, d);
    if (!map.alive(e))
      return BrokenAxiom{d, fmt::format("every link leads to a dart: α{}({}) was removed", i, d.value)};
    const Dart back = map.alpha(i, e);
    if (back != d)
      return BrokenAxiom{d,
                         fmt::format("α{0} is an involution: α{0}(α{0}({1})) = {2}", i, d.value, back.value)};
  }
  if (map.dimension() == 2 && !map.is_free(3, d))
    return BrokenAxiom{
        d, fmt::format("a dart of a sheet is α3-free: α3({}) = {}", d.value, map.alpha(3, d).value)};
  return {};
}

std::optional<BrokenAxiom> fault_of_cycles(const GMap& map, Dart d) {
  for (int i = 0; i < 4; ++i) {
    for (int j = i + 2; j < 4; ++j) {
      const Dart once = map.alpha(j, map.alpha(i, d));
      const Dart twice = map.alpha(j, map.alpha(i, once));
      if (twice != d)
        return BrokenAxiom{d, fmt::format("α{0}α{1} is an involution: followed twice from {2} it leads to {3}",
                                          i, j, d.value, twice.value)};
    }
  }
  return {};
}

} // namespace

std::string BrokenAxiom::text() const {
  return fmt::format("dart {}: {}", dart.value, axiom);
}

std::optional<BrokenAxiom> validate(const GMap& map) {
  std::optional<BrokenAxiom> fault;
  map.for_each_dart([&](Dart d) {
    if (!fault) fault = fault_of_links(map, d);
  });
  if (fault) return fault; // the cycle checks could walk into removed darts
  map.for_each_dart([&](Dart d) {
    if (!fault) fault = fault_of_cycles(map, d);
  });
  return fault;
}

} // namespace rend
