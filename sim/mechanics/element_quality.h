// How good the shapes of elements are, at rest. A mesh is as good as its worst element: one that is flat or
// thin limits the stable step of all others (rows/frequency.h), and makes the stiffness badly conditioned
// (Shewchuk, "What is a good linear element?", 2002).
//
//   angles   between faces, along each edge of a cell (dihedral); of a sheet between sides, at each corner
//   aspect   l S/(c V): l the longest edge, S the surface, V the volume; of a sheet l P/(c A) with perimeter
//            and area. c is the same of the shape with equal sides, so that this has 1, and all else more
//            (Stimpson et al., The Verdict Library Reference Manual, 2007, for triangles and tetrahedra)
//   size     V or A; beside the mean over the mesh, their ratio
//
// A sliver, four points around a circle, has sides of nearly the same length; its angles and its aspect tell.
// Each face is taken as its mean plane.
#pragma once

#include "sim/embedding/embedded_map.h"

#include <string>

namespace rend {

struct ElementQuality {
  double least_angle = 0, greatest_angle = 0; // [degrees]
  double aspect = 1;                          // infinite: no volume
  double size = 0;                            // [m³] of a solid, [m²] of a sheet
};

// Of the element of d: a face of a sheet, a volume of a solid.
ElementQuality quality_of(const EmbeddedMap& map, Dart d);

// "tetrahedron", "quad", ...; "polygon" and "polyhedron" for the others.
std::string element_name(const EmbeddedMap& map, Dart d);

Vec3 element_centre(const EmbeddedMap& map, Dart d); // [m], mean of its corners at rest

// The element that has the worst value of a mesh.
struct WorstElement {
  double value = 0;
  Slot element = 0; // number, in the order of smallest darts
  std::string kind; // element_name()
  Vec3 centre = Vec3::Zero();
};

struct MeshQuality {
  WorstElement least_angle, greatest_angle; // [degrees]
  WorstElement aspect;
  WorstElement smallest, largest; // size over the mean size
};

// Elements of the map, at least one. Of equal values the first counts.
MeshQuality mesh_quality(const EmbeddedMap& map);

} // namespace rend
