// Slits: cuts that a sheet of triangles has from the start: the notch of a specimen, a perforation.
//
//   <body> <sheet pattern="triangles" cells="20 10" size="2 1"/> <slit along="0.8 0.5 0  1.2 0.6 0"/> </body>
//   <slit along="-1 0.5 0  3 0.5 0" dash="0.04 0.02"/>    cut for 0.04 m, left for 0.02 m, and so on
//
// Points are those of the shape, before it is placed. A slit goes through the cells as a crack does
// (sim/cuts/triangle_cut.h): from vertex to vertex, straight to the next of its points. Near each point
// within the sheet a vertex is moved or created: at the point, or at most a tenth of an element beside it; on
// the border, an end may be moved to a vertex within a quarter of an edge. A slit may begin and end outside;
// it ends where it leaves its body, at a hole too. Both of its sides are free, and part of the border at the
// start. Slits may cross.
//
// With dashes the way is the same, and its edges are opened where a dash is. A dash ends at a vertex on the way
// within a quarter of an edge, or at one that is created, if no part is too small then; or else at the nearest.
#pragma once

#include "sim/base/settings.h"
#include "sim/embedding/embedded_map.h"

#include <optional>
#include <span>
#include <vector>

namespace rend {

struct SlitSettings {
  std::vector<double> along = {};               // x y z of each point, one after another [m]
  std::optional<std::vector<double>> dash = {}; // lengths that are cut and left in turn [m]; none: all is cut
  SettingsSource source = {};
};
template <> const Fields<SlitSettings>& fields_of();

// Velocities are 0, positions those at rest. UserError: a slit outside of its body or without a length; a body
// that is no sheet of triangles.
void cut_slits(EmbeddedMap& map, std::span<const SlitSettings> slits);

} // namespace rend
