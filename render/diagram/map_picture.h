// A small map, drawn: its cells side by side, so that what is linked, and what is not, can be seen.
//
// Faces of a sheet, and volumes of a solid, are drawn a little smaller around their middles; a blue stroke
// across the gap is a link α2, a green one α3. What lies in a plane z = const is seen from above, anything
// else obliquely.
#pragma once

#include "render/diagram/drawing.h"
#include "sim/embedding/embedded_map.h"

#include <vector>

namespace rend {

// Where points of maps lie in drawings. The same view for several maps, so that they can be compared.
struct MapView {
  bool flat = true; // seen from above
  Spot low, high;   // of all points [m]

  static MapView of(const std::vector<const EmbeddedMap*>& maps);
  Spot project(const Vec3& x) const; // [m], y up
  double scale(double side) const;   // of pixels to metres, to fit into a square
  double height(double side) const;  // [pixels], of what is seen at that scale, with a margin
};

// `marked`: darts to point out. `side`: the width of the drawing, and the most that it is high [pixels].
Drawing picture_of(const EmbeddedMap& map, const MapView& view, const std::vector<Dart>& marked, double side);

} // namespace rend
