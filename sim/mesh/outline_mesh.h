// Triangles within an outline, and the solid above them.
//
// A lattice of equilateral triangles, whose vertices near the outline move onto it, and whose edges that still
// cross it are cut there (in two dimensions what isosurface stuffing is in three: Labelle & Shewchuk 2007):
//
//   1. a corner of the outline (a turn by more than 25°) takes the nearest vertex
//   2. a vertex at an edge that the outline crosses within 0.3 of its length moves to that crossing; so do both
//      ends of an edge that it crosses twice, once in each half, as at a sharp tip or notch
//   3. an edge that is still crossed gets a vertex at the crossing
//
// Then vertices inside move to the middle of their neighbours where the least angle around them grows by it.
// Parts of the outline that are thinner than a cell are lost, or become wider: a sharp tip may become blunt.
#pragma once

#include "sim/base/settings.h"
#include "sim/mesh/cells.h"
#include "sim/mesh/outline.h"
#include "sim/mesh/polygons.h"

#include <optional>

namespace rend {

struct OutlineShape {
  OutlineName name = OutlineName::Path;
  std::string path = {};            // data of an SVG path
  std::string file = {};            // an SVG file, relative to the preset; of a program, to where it runs
  std::string text = {};            // letters. Of name, path, file and text one is given
  std::optional<double> size = {};  // [m]
  double cell = 0;                  // [m]
  std::optional<double> depth = {}; // [m]
  SettingsSource source = {};
};
template <> const Fields<OutlineShape>& fields_of();

// Of edges about as long as `cell` [m], in the plane z = 0. Empty: the outline is thinner than that everywhere.
PolygonMesh triangles_within(const Outline& outline, double cell);

// The number of parts whose triangles are connected by edges.
int parts_of(const PolygonMesh& triangles);

// [m²]
double area_of(const PolygonMesh& triangles);

// Tetrahedra between z = 0 and z = depth [m], in so many layers; each prism above a triangle is cut in three.
CellMesh extruded(const PolygonMesh& triangles, double depth, int layers);

} // namespace rend
