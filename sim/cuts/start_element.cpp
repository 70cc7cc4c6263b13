#include "sim/cuts/start_element.h"

#include "sim/mechanics/mass.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rend {
ElementSizes::ElementSizes(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double u = (b - a).norm(), v = (c - b).norm(), w = (a - c).norm();
  size = (b - a).cross(c - a).norm();
  sine = size * std::min({u, v, w}) / (u * v * w);
}

// At an edge of length l between faces of areas A and B, sin = 3 V l / 2 A B.
ElementSizes::ElementSizes(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const std::array<Vec3, 4> corner{a, b, c, d};
  std::array<double, 4> area; // twice that of the face opposite to each corner
  for (std::size_t n = 0; n < 4; ++n) {
    const Vec3& at = corner[(n + 1) % 4];
    area[n] = (corner[(n + 2) % 4] - at).cross(corner[(n + 3) % 4] - at).norm();
  }
  size = std::abs((b - a).cross(c - a).dot(d - a));
  sine = 1;
  for (std::size_t n = 0; n < 4; ++n)
    for (std::size_t m = n + 1; m < 4; ++m) { // at the edge of the other two corners
      const std::size_t i = n == 0 ? (m == 1 ? 2 : 1) : 0, j = 6 - n - m - i;
      sine = std::min(sine, size * (corner[i] - corner[j]).norm() / (area[n] * area[m]));
    }
}

StartElement StartElement::on(const EmbeddedMap& map) const {
  StartElement there = *this;
  there.orbit = element_orbit(map.dimension());
  return there;
}

ElementSizes StartElement::birth(const EmbeddedMap& map, Dart d) const {
  const GMap& g = map.map();
  const Vec3 a = map.rest_of(d), b = map.rest_of(g.alpha(0, d)), c = map.rest_of(g.alpha(0, g.alpha(1, d)));
  if (orbit == FaceOfVolume) return {a, b, c};
  return {a, b, c, map.rest_of(g.alpha(0, g.alpha(1, g.alpha(2, d))))};
}

const Column<StartElement>* find_start_elements(const EmbeddedMap& map) {
  return find_column<StartElement>(map);
}

Column<StartElement>* find_start_elements(EmbeddedMap& map) {
  return const_cast<Column<StartElement>*>(find_start_elements(std::as_const(map)));
}

void add_start_elements(EmbeddedMap& map) {
  if (!find_start_elements(map)) map.add(StartElement{}.on(map));
}

void hand_on_start_elements(const EmbeddedMap& from, EmbeddedMap& to, std::span<const Dart> order,
                            double scale) {
  const Column<StartElement>* old = find_start_elements(from);
  if (!old) return;
  add_start_elements(to);
  Column<StartElement>& start = *find_start_elements(to);
  const double factor = (to.dimension() == 3 ? scale : 1) * scale * scale;
  const CellIndex& elements = to.cells(start.orbit());
  for (Slot e = 0; e < elements.slots(); ++e) {
    if (!elements.alive(e)) continue;
    start[e] = (*old)[from.slot(old->orbit(), order[elements.first_dart(e).value])];
    start[e].size *= factor;
  }
}

} // namespace rend
