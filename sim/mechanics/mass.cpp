#include "sim/mechanics/mass.h"

#include "sim/mechanics/interaction.h"
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

double CornerMass::birth(const EmbeddedMap& map, Dart d) const {
  const int sides = sides_of_face(map.map(), d);
  return sides == 0 ? 0 : density * rest_area(map, d) / sides;
}

double CornerDrag::birth(const EmbeddedMap& map, Dart d) const {
  const std::vector<Dart> darts = darts_of(map.map(), Vertex, d);
  std::size_t corners = 0;
  for (Dart e : darts) corners += e <= map.map().alpha(1, e); // a corner has two darts, or one
  return per_vertex / static_cast<double>(corners);
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
  darts.clear();
  collect(map.map(), Vertex, d, darts);
  std::erase_if(darts, [&](Dart e) { return cells.first_dart(cells.slot(e)) != e; });
  std::sort(darts.begin(), darts.end());
  double sum = 0;
  for (Dart e : darts) sum += values[cells.slot(e)];
  return sum;
}

} // namespace rend
