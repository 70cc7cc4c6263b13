// Lumped mass and ambient viscosity on the corners of elements.
//
// Each corner of an element carries a share of its mass; the mass of a vertex is the sum over its corners. A
// separation regroups the corners without changing them, so that mass and momentum, summed over corners in the
// order of darts, are conserved to the last bit. Where an edit divides elements and says so (Edit::inherit),
// mass and viscosity of the old element are shared by the new ones, by area or volume, and the momentum is kept
// (embedding/inheritance.h).
#pragma once

#include "sim/base/settings.h"
#include "sim/embedding/cell_size.h"
#include "sim/mechanics/element_expression.h"

namespace rend {

// One of total, density and density_by_place.
struct MassSettings {
  std::optional<double> total = {};      // [kg], spread by area or volume
  std::optional<double> density = {};    // [kg/m³]
  std::string density_by_place = {};     // [kg/m³], an expression: element_expression.h; empty: none
  ExpressionSettings of_expression = {}; // its seed and its picture
  std::optional<double> thickness = {};  // [m], of a sheet that has a density
  SettingsSource source = {};

  bool has_density() const { return density || !density_by_place.empty(); }
};
template <> const Fields<MassSettings>& fields_of();

ElementQuantity density_quantity();

struct ViscositySettings {
  double value = 0; // [N·s/m]
  enum class Per { Particle, Body } per = Per::Particle;
  SettingsSource source = {};
};
template <> const Fields<ViscositySettings>& fields_of();

// Where an element's corner is: <1> on a sheet, <1,2> in a solid; and the element itself.
constexpr Orbit corner_orbit(int dimension) {
  return dimension == 2 ? VertexOfFace : VertexOfVolume;
}

// Element mass / number of corners [kg]. An element has the density that there is in its middle. The default
// orbit and support are those of a sheet; on() sets those of a map.
struct CornerMass {
  using Value = double;
  std::string name = "corner mass";
  Orbit orbit = VertexOfFace;
  Orbit support = FaceOfVolume;
  double density = 0; // [kg/m²] of a sheet, [kg/m³] of a solid
  // By which it is multiplied, then a thickness [m] of a sheet, or 1; null: 1 everywhere.
  std::shared_ptr<const ElementExpression> by_place = {}; // [kg/m³]
  Value birth(const EmbeddedMap& map, Dart d) const;
  Value split(const Value& whole) const { return whole; }
  static constexpr Inheritance inheritance = Inheritance::Share;
  static constexpr bool carries_momentum = true;
  Value inherit(const EmbeddedMap&, Dart, std::span<const Inherited<Value>> parents) const {
    return sum_of(parents);
  }
  CornerMass on(const EmbeddedMap& map) const;
};
using MassColumn = Column<CornerMass>;

// The corner's share of its vertex's ambient viscosity [N·s/m].
struct CornerDrag {
  using Value = double;
  std::string name = "corner viscosity";
  Orbit orbit = VertexOfFace;
  Orbit support = FaceOfVolume;
  double per_vertex = 0; // [N·s/m] of a vertex of the undamaged body
  Value birth(const EmbeddedMap& map, Dart d) const;
  Value split(const Value& whole) const { return whole; }
  static constexpr Inheritance inheritance = Inheritance::Share;
  Value inherit(const EmbeddedMap&, Dart, std::span<const Inherited<Value>> parents) const {
    return sum_of(parents);
  }
  CornerDrag on(const EmbeddedMap& map) const;
};
using DragColumn = Column<CornerDrag>;

// Sums over corners in the order of their smallest darts.
double total_mass(const EmbeddedMap& map, const MassColumn& mass);
Vec3 total_momentum(const EmbeddedMap& map, const MassColumn& mass); // Σ m v [kg·m/s]
Vec3 total_angular_momentum(const EmbeddedMap& map,
                            const MassColumn& mass); // Σ m x × v [kg·m²/s], about the origin
double kinetic_energy(const EmbeddedMap& map, const MassColumn& mass);                      // [J]
double gravity_energy(const EmbeddedMap& map, const MassColumn& mass, const Vec3& gravity); // [J]

// The sum of a corner column over the corners of a vertex, in the order of their smallest darts.
double sum_at_vertex(const EmbeddedMap& map, Orbit corner, const std::vector<double>& values, Dart d);

} // namespace rend
