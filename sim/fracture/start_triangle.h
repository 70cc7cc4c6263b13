// Of which triangle of the start an element is a part, by the sizes of that one at rest: cuts leave no part of
// it too small or thin (triangle_cut.h). What divides an element hands them on; what makes one from nothing
// begins anew. Only bodies with cuts or slits have this embedding.
#pragma once

#include "sim/embedding/embedded_map.h"

#include <span>

namespace rend {

struct TriangleSizes {
  double twice_area = 0; // [m²]
  double sine = 0;       // of the least angle

  TriangleSizes() = default;
  TriangleSizes(const Vec3& a, const Vec3& b, const Vec3& c);  // [m]
  void scale(double factor) { twice_area *= factor * factor; } // of lengths
};

struct StartTriangle {
  using Value = TriangleSizes;
  std::string name = "triangle of the start";
  Orbit orbit = FaceOfVolume;
  Orbit support = SingleDart; // what moves its corners does not change it
  Value birth(const EmbeddedMap& map, Dart d) const;
  Value split(const Value& whole) const { return whole; }
  Value inherit(const EmbeddedMap&, Dart, std::span<const Inherited<Value>> parents) const {
    return parents.front().value;
  }
};

// The embedding of this map; null: it has none.
const Column<StartTriangle>* find_start_triangles(const EmbeddedMap& map);
Column<StartTriangle>* find_start_triangles(EmbeddedMap& map);

// Adds it to a sheet that has none: its elements as they are now. No sheet: nothing.
void add_start_triangles(EmbeddedMap& map);

// To a map that was made from another one: order[n] is the dart there of dart n here, lengths are `scale` times
// as long. A map without the embedding hands on nothing.
void hand_on_start_triangles(const EmbeddedMap& from, EmbeddedMap& to, std::span<const Dart> order,
                             double scale);

} // namespace rend
