#include "sim/mechanics/mass.h"

#include "sim/mechanics/interaction.h"
#include "sim/topology/index_set.h"
#include "sim/topology/walk.h"

#include <algorithm>

namespace rend {

double rest_area(const EmbeddedMap& map, Dart d) {
  std::vector<Vec3> x;
  Dart at = d;
  do {
    x.push_back(map.rest_of(at));
    at = map.map().alpha(1, map.map().alpha(0, at));
  } while (at != d);
  Vec3 centre = Vec3::Zero();
  for (const Vec3& p : x) centre += p;
  centre /= static_cast<double>(x.size());
  double area = 0;
  for (std::size_t n = 0; n < x.size(); ++n)
    area += 0.5 * (x[n] - centre).cross(x[(n + 1) % x.size()] - centre).norm();
  return area;
}

namespace {

// Calls f(d) once for each face of the volume of d, with a dart of it that turns as d does: all faces are then
// seen turning the same way from inside.
template <class F> void each_face_of_volume(const GMap& map, Dart d, F&& f) {
  thread_local IndexSet faces; // the smallest dart of each
  thread_local std::vector<Dart> found;
  faces.clear();
  found.assign(1, d);
  const auto visit = [&](Dart start) {
    Dart smallest = start;
    walk_two(map, 0, 1, start, [&](Dart e) { smallest = std::min(smallest, e); });
    return faces.insert(smallest.value);
  };
  visit(d);
  for (std::size_t n = 0; n < found.size(); ++n) {
    const Dart face = found[n];
    f(face);
    Dart at = face;
    do {
      const Dart across = map.alpha(2, map.alpha(0, at));
      if (visit(across)) found.push_back(across);
      at = map.alpha(1, map.alpha(0, at));
    } while (at != face);
  }
}

} // namespace

double rest_volume(const EmbeddedMap& map, Dart d) {
  const Vec3 origin = map.rest_of(d); // any point would do: the faces enclose the volume
  double sixfold = 0;
  thread_local std::vector<Vec3> x;
  each_face_of_volume(map.map(), d, [&](Dart face) {
    x.clear();
    Vec3 centre = Vec3::Zero();
    Dart at = face;
    do {
      x.push_back(map.rest_of(at) - origin);
      centre += x.back();
      at = map.map().alpha(1, map.map().alpha(0, at));
    } while (at != face);
    centre /= static_cast<double>(x.size());
    for (std::size_t n = 0; n < x.size(); ++n) sixfold += centre.dot(x[n].cross(x[(n + 1) % x.size()]));
  });
  return std::abs(sixfold) / 6;
}

int corners_of_volume(const GMap& map, Dart d) {
  int corners = 0;
  each_face_of_volume(map, d, [&](Dart face) {
    Dart at = face;
    do { // a corner is counted in that of its faces whose dart is the smallest
      Dart smallest = at, here = map.alpha(2, map.alpha(1, at));
      for (; here != at; here = map.alpha(2, map.alpha(1, here))) smallest = std::min(smallest, here);
      corners += smallest == at;
      at = map.alpha(1, map.alpha(0, at));
    } while (at != face);
  });
  return corners;
}

double CornerMass::birth(const EmbeddedMap& map, Dart d) const {
  if (map.dimension() == 3) return density * rest_volume(map, d) / corners_of_volume(map.map(), d);
  const int sides = sides_of_face(map.map(), d);
  return sides == 0 ? 0 : density * rest_area(map, d) / sides;
}

CornerMass CornerMass::on(const EmbeddedMap& map) const {
  CornerMass mass = *this;
  mass.orbit = corner_orbit(map.dimension());
  mass.support = element_orbit(map.dimension());
  return mass;
}

double CornerDrag::birth(const EmbeddedMap& map, Dart d) const {
  const std::vector<Dart> darts = darts_of(map.map(), Vertex, d);
  std::size_t corners = 0;
  if (map.dimension() == 3) {
    const CellIndex& cells = map.cells(VertexOfVolume);
    for (Dart e : darts) corners += cells.first_dart(cells.slot(e)) == e;
  } else {
    for (Dart e : darts) corners += e <= map.map().alpha(1, e); // a corner has two darts, or one
  }
  return per_vertex / static_cast<double>(corners);
}

CornerDrag CornerDrag::on(const EmbeddedMap& map) const {
  CornerDrag drag = *this;
  drag.orbit = corner_orbit(map.dimension());
  drag.support = element_orbit(map.dimension());
  return drag;
}

namespace {

// Calls f(corner slot, dart) for every corner in the order of smallest darts.
template <class F> void each_corner(const EmbeddedMap& map, Orbit corner, F&& f) {
  const CellIndex& cells = map.cells(corner);
  map.map().for_each_dart([&](Dart d) {
    const Slot slot = cells.slot(d);
    if (cells.first_dart(slot) == d) f(slot, d);
  });
}

} // namespace

double total_mass(const EmbeddedMap& map, const MassColumn& mass) {
  double sum = 0;
  each_corner(map, mass.orbit(), [&](Slot c, Dart) { sum += mass[c]; });
  return sum;
}

Vec3 total_momentum(const EmbeddedMap& map, const MassColumn& mass) {
  Vec3 sum = Vec3::Zero();
  each_corner(map, mass.orbit(), [&](Slot c, Dart d) { sum += mass[c] * map.velocity()[map.vertex(d)].vec(); });
  return sum;
}

Vec3 total_angular_momentum(const EmbeddedMap& map, const MassColumn& mass) {
  Vec3 sum = Vec3::Zero();
  each_corner(map, mass.orbit(), [&](Slot c, Dart d) {
    const Slot v = map.vertex(d);
    sum += mass[c] * map.position()[v].vec().cross(map.velocity()[v].vec());
  });
  return sum;
}

double kinetic_energy(const EmbeddedMap& map, const MassColumn& mass) {
  double sum = 0;
  each_corner(map, mass.orbit(), [&](Slot c, Dart d) {
    sum += 0.5 * mass[c] * map.velocity()[map.vertex(d)].vec().squaredNorm();
  });
  return sum;
}

double gravity_energy(const EmbeddedMap& map, const MassColumn& mass, const Vec3& gravity) {
  double sum = 0;
  each_corner(map, mass.orbit(), [&](Slot c, Dart d) { sum -= mass[c] * gravity.dot(map.position_of(d)); });
  return sum;
}

double sum_at_vertex(const EmbeddedMap& map, Orbit corner, const std::vector<double>& values, Dart d) {
  const CellIndex& cells = map.cells(corner);
  thread_local std::vector<Dart> darts;
  thread_local std::vector<std::pair<Dart, Slot>> corners; // smallest dart and slot
  darts.clear();
  corners.clear();
  collect(map.map(), Vertex, d, darts);
  Slot last = no_slot;
  for (Dart e : darts) { // the darts of a corner mostly follow each other
    const Slot slot = cells.slot(e);
    if (slot != last) corners.push_back({cells.first_dart(slot), slot});
    last = slot;
  }
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  double sum = 0;
  for (const auto& [first, slot] : corners) sum += values[slot];
  return sum;
}

} // namespace rend
