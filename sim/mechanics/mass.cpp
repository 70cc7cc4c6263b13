#include "sim/mechanics/mass.h"

#include "sim/base/reach.h"
#include "sim/mechanics/interaction.h"
#include "sim/topology/index_set.h"
#include "sim/topology/walk.h"

#include <algorithm>
#include <array>

namespace rend {

namespace {

// A number, or an expression.
Field<MassSettings> density_field() {
  const AttributeType type =
      number_or_expression(
          "density", "kg/m3",
          "density, instead of total; a sheet needs its thickness as well. It may differ from "
          "element to element: an expression of rest (the middle of the element [m]), u and v "
          "(its place in a picture, 0 to 1), picture, random, weibull(m), in(group), noise(...)")
          .above(0)
          .at_most(heaviest);
  return {type,
          [](MassSettings& mass, const AttributeValue& value) {
            if (value.word)
              mass.density_by_place = value.text;
            else
              mass.density = value.numbers.at(0);
          },
          [type](const MassSettings& mass, const SettingsSource& source) {
            if (mass.density) fields::check_numbers(type, std::array{*mass.density}, source);
          }};
}

} // namespace

template <> const Fields<MassSettings>& fields_of() {
  using S = MassSettings;
  static const Fields<S> fields =
      Fields<S>{field(&S::total, number("total", "kg", "mass of the whole body, spread by area or volume")
                                     .above(0)
                                     .at_most(heaviest)),
                density_field(),
                field(&S::thickness, number("thickness", "m", "thickness of the sheet").above(0))} +
      fields_of_part(&S::of_expression);
  return fields;
}

ElementQuantity density_quantity() {
  return {.element = "mass",
          .attribute = "density",
          .above = 0,
          .most = heaviest,
          .hint = "max(100, ...) keeps it above 100 kg/m3",
          .example = "density=\"200 + 800*picture\""};
}

template <> const Fields<ViscositySettings>& fields_of() {
  using S = ViscositySettings;
  static const Fields<S> fields{
      field(&S::value, number("value", "N.s/m", "the coefficient").at_least(0).is_required()),
      field(&S::per, word("per", {"particle", "body"},
                          "particle: each vertex has this coefficient; body: it is shared among the vertices "
                          "as the mass is"))};
  return fields;
}

double CornerMass::birth(const EmbeddedMap& map, Dart d) const {
  const int corners = map.dimension() == 3 ? corners_of_volume(map.map(), d) : sides_of_face(map.map(), d);
  if (corners == 0) return 0;
  const double there = by_place ? density * by_place->at(map, d) : density;
  return there * (map.dimension() == 3 ? rest_volume(map, d) : rest_area(map, d)) / corners;
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
  for (Dart e : darts) { // the darts of a corner mostly come consecutively
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
