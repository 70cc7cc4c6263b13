// Curved triangles: a coarse surface drawn as the smooth one that its normals describe, so that its outline is
// no polygon.
//
// Each triangle becomes a cubic Bézier patch through its corners, perpendicular to their normals. Along a side
// from a to b (positions p, unit normals n) its control points are
//
//   c_ab = (2 p_a + p_b - ((p_b - p_a)·n_a) n_a) / 3     and c_ba likewise,
//
// and its middle one is e + (e - m) / 2, e the mean of the six on the sides, m that of the corners. A side
// follows from its two ends alone, so that two triangles that share it and their normals have no gap between
// them. Sides where normals differ from one triangle to the next (creases, torn edges) stay straight. (A
// vertex without a normal, as in a sheet that is folded flat, has one in each triangle: beside it there may be
// gaps.) Normals, colours and places in pictures are linear over the triangle.
//
// Source: Vlachos, Peters, Boyd and Mitchell, Curved PN triangles, 2001.
#pragma once

#include "render/draw/frame.h"

namespace rend {

// Draws each triangle as parts x parts smaller ones. parts >= 1; 1: nothing changes.
void curve_triangles(FrameBody& body, int parts);

} // namespace rend
