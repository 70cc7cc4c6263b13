#include "sim/cuts/crack_front.h"

#include "sim/base/math.h"
#include "sim/topology/index_set.h"

#include <algorithm>

namespace rend {
namespace {

constexpr double front_angle = 300 * pi / 180; // of the matter around a front edge, at least

} // namespace

CrackFront::CrackFront(const EmbeddedMap& map, std::span<const Dart> darts) : map_(map) {
  const GMap& g = map_.map();
  IndexSet seen;
  for (Dart first : darts) {
    if (!g.is_free(3, first) || seen.contains(first.value)) continue;
    Cycle& cycle = cycles_.emplace_back();
    Dart d = first;
    do {
      cycle.edges.push_back(edge_after(d));
      seen.insert(d.value);
      seen.insert(cycle.edges.back().after.value);
      d = g.alpha(1, cycle.edges.back().after);
    } while (d != first);
    for (std::size_t n = 0; n < cycle.edges.size(); ++n)
      if (cycle.edges[n].angle > front_angle) cycle.fronts.push_back(n);
  }
}

bool CrackFront::passes() const {
  return std::ranges::any_of(cycles_, [](const Cycle& cycle) { return !cycle.fronts.empty(); });
}

// The edge of d, a dart of v in a border face, and the face on its other side.
CrackFront::BorderEdge CrackFront::edge_after(Dart d) const {
  const GMap& g = map_.map();
  const Vec3 here = map_.rest_of(d), edge = (map_.rest_of(g.alpha(0, d)) - here).normalized();
  const auto away = [&](Dart e) {
    const Vec3 third = map_.rest_of(g.alpha(0, g.alpha(1, e))) - here;
    return Vec3(third - third.dot(edge) * edge);
  };
  BorderEdge found{d, d, 0};
  for (;;) {
    const Dart other = g.alpha(2, found.after);
    const Vec3 a = away(found.after), b = away(other);
    found.angle += arc_tangent(a.cross(b).norm(), a.dot(b));
    found.after = other;
    if (g.is_free(3, other)) return found;
    found.after = g.alpha(3, other);
  }
}

} // namespace rend
