// Texture coordinates: the place in a picture of each corner of a face of a sheet, where its mesh has them.
//
// They belong to corners, and not to vertices: at a seam the two faces at an edge lie in different parts of the
// picture, and each face is divided with its own coordinates. What becomes of a corner:
//
//   old, also if its vertex is torn or its face divided   keeps its place, bit for bit
//   born on a side from a to b, or within a face          Σ w uv of the corners of that face at the vertices
//                                                         that the new one lies between: (1 − t) a + t b
//   two that become one                                   that of the smaller dart
//   born of nothing                                       the middle of the picture
//
// So where the places are an affine function of rest positions they stay so, on each side of a seam. A vertex
// that is moved at rest keeps its places, and takes the picture along. A rule that gives a vertex a place among
// vertices of several faces (Catmull and Clark) mixes what these have: across a seam, that of both sides.
//
// A body has this embedding only if its mesh file has texture coordinates and its look shows a picture outside.
#pragma once

#include "sim/embedding/embedded_map.h"

namespace rend {

// u to the right, v up; the picture covers 0 to 1.
struct TexturePlace {
  double u = 0.5, v = 0.5;
  bool operator==(const TexturePlace&) const = default;
};

struct TextureCoordinates {
  using Value = TexturePlace;
  std::string name = "texture coordinates";
  Orbit orbit = VertexOfFace;
  Orbit support = SingleDart;
  Value birth(const EmbeddedMap&, Dart) const { return {}; }
  Value split(const Value& whole) const { return whole; }
  Value merge(const Value& kept, const Value&) const { return kept; }
  Value inherit(const EmbeddedMap&, Dart, std::span<const Inherited<Value>> parents) const {
    if (parents.size() == 1) return parents.front().value;
    Value mean{0, 0};
    for (const Inherited<Value>& parent : parents) {
      mean.u += parent.weight * parent.value.u;
      mean.v += parent.weight * parent.value.v;
    }
    return mean;
  }
};

// The embedding of this map; null: it has none.
inline const Column<TextureCoordinates>* find_texture_coordinates(const EmbeddedMap& map) {
  return find_column<TextureCoordinates>(map);
}

} // namespace rend
