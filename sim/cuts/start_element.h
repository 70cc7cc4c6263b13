// Of which element of the start one is a part, by the sizes of that one at rest: cuts leave no part of it too
// small or thin (triangle_cut.h, tetrahedron_cut.h). What divides an element hands them on; what makes one from
// nothing begins anew. Only bodies with cuts or slits have this embedding: sheets of triangles, solids of
// tetrahedra.
#pragma once

#include "sim/cuts/least_part.h"
#include "sim/embedding/embedded_map.h"

#include <span>

namespace rend {

struct ElementSizes {
  double size = 0; // twice the area [m²] of a triangle, six times the volume [m³] of a tetrahedron
  double sine = 0; // of the angle, or dihedral angle, that is closest to 0 or 180°

  ElementSizes() = default;
  ElementSizes(const Vec3& a, const Vec3& b, const Vec3& c);                // of a triangle [m]
  ElementSizes(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d); // of a tetrahedron [m]
  // Whether it may be a part of that element.
  bool may_be_part(const ElementSizes& start, const LeastPart& least) const {
    return size >= least.size * start.size && sine >= least.sine * start.sine;
  }
};

struct StartElement {
  using Value = ElementSizes;
  std::string name = "element of the start";
  Orbit orbit = FaceOfVolume;
  Orbit support = SingleDart; // what moves its corners does not change it
  Value birth(const EmbeddedMap& map, Dart d) const;
  Value split(const Value& whole) const { return whole; }
  Value inherit(const EmbeddedMap&, Dart, std::span<const Inherited<Value>> parents) const {
    return parents.front().value;
  }
  StartElement on(const EmbeddedMap& map) const;
};

// The embedding of this map; null: it has none.
const Column<StartElement>* find_start_elements(const EmbeddedMap& map);
Column<StartElement>* find_start_elements(EmbeddedMap& map);

// Adds it to a body that has none: its elements as they are now.
void add_start_elements(EmbeddedMap& map);

// To a map that was made from another one: order[n] is the dart there of dart n here, lengths are `scale` times
// as long. A map without the embedding hands on nothing.
void hand_on_start_elements(const EmbeddedMap& from, EmbeddedMap& to, std::span<const Dart> order,
                            double scale);

} // namespace rend
