// The rim of a sheet that is drawn with a thickness h: its front and its back lie half of that off along the
// normals of its vertices, and the rim closes them along every edge that has one face. So a tear looks like
// paper or cloth, and not like a wire.
//
// With N the normal at a place of an edge, O the direction out of the sheet across N, and φ from 0 at the front
// to 180° at the back, the rim is
//
//   whole edges   x + h/2 (cos φ N + sin φ O), φ in 4 equal parts: half a circle
//   torn edges    a ridge between front and back: x + h/2 (a O + b N), a from 0.2 to 1.4 and b from −0.4 to
//                 0.4, irregular along the edge, by noise of the position at rest
//
// How a torn edge is divided hangs on its length at rest, so that nothing flickers: as the sheet moves, the
// same corners come in the same order.
#pragma once

#include "render/draw/frame.h"
#include "render/picture/colour.h"
#include "sim/boundary/surface.h"

#include <functional>
#include <span>

namespace rend {

// A vertex normal of a sheet has an arbitrary sign: turned to the side of one of its triangles, whose normal is
// `flat`, of any length.
Vec3 normal_on_side(const Vec3& normal, const Vec3& flat);

struct SheetRim {
  const EmbeddedMap& map;
  const Surface& surface;
  std::span<const Vec3> normals; // Surface::normals()
  double thickness;              // [m]
  // At corner k of a triangle, where the edge opposite to it is torn or not.
  std::function<Colour(const BoundaryTriangle&, std::size_t k, bool torn)> colour;
};

// Appends the triangles to `out`, counter-clockwise as seen from outside.
void draw_rim(const SheetRim& rim, FrameBody& out);

} // namespace rend
