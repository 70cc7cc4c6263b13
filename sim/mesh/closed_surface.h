// Closed surfaces, and the solids within them.
//
// A file of polygons (.obj, .off) is a sheet, also where the surface is closed: a hollow shell. A mesh
// generator can fill it with tetrahedra (`rend mesh fill`). It gets the triangles of the surface,
// and keeps them: so the boundary of the solid can be compared with them, triangle by triangle.
#pragma once

#include "sim/mesh/reader.h"

#include <array>
#include <vector>

namespace rend {

struct ClosedSurface {
  std::vector<Vec3> points;                            // [m]
  std::vector<std::array<std::uint32_t, 3>> triangles; // indices of points, counter-clockwise from outside

  double volume() const; // [m³], within
  double size() const;   // [m], diagonal of the bounding box
};

// Of a file of polygons, each divided into triangles: a quad at its shorter diagonal, others as a fan.
// UserError (65), with the place of a polygon: it is a solid, is not closed, has only one side, or consists
// of several parts.
ClosedSurface closed_surface(const MeshFile& file);

// UserError (Usage): to fill the surface with tetrahedra whose edges are about `size` [m] long would take more
// than ten million, by the volume that such a one has in what Gmsh makes (six fill a cube of that side).
void check_cells_to_fill(const ClosedSurface& surface, double size);

// Divides edges in the middle until none is longer than `most` [m]: the same surface in smaller triangles.
// UserError (Usage): they would be more than ten million; known at once where the area alone says so.
void divide_edges(ClosedSurface& surface, double most);

// Triangles as Gmsh's .msh 2.2, of the entity 1.
std::string msh_text(const ClosedSurface& surface);

// What is wrong with a solid that should fill the surface: a cell of another kind or without positive volume, a
// face of its boundary that is no triangle of the surface or the reverse (points within 1e-9 of the size), a
// volume that differs by more than 1e-9. Empty: nothing.
std::string flaw_of_filling(const CellMesh& solid, const ClosedSurface& surface);

} // namespace rend
