// Tetrahedra into eight, all of a component, so that they fit to each other (Bey 1995): each edge is halved,
// the four corners are cut off, and the octahedron that is left is divided into four along its shortest axis.
// Of axes that are equally long, the first one in the order of darts is taken: it lies inside, and no
// neighbour sees it.
//
// The corners are those of the vertices that were there before; the octahedra have new darts alone.
#include "sim/house_rules/house_scripts.h"

namespace rend {

ScriptSettings divide_tetrahedra() {
  using enum ScriptStepSettings::Which;
  return {.name = "divide-tetrahedra",
          .about = "each tetrahedron becomes eight, which fit to those of its neighbours",
          .hook = "a*(0,1,2,3)",
          .steps = {{.each = "e*(0,2,3)", .apply = "insert-vertex"},
                    {.each = "e*(1,3)", .apply = "cut-face-corner", .which = Old},
                    {.each = "e*(1,2)", .apply = "cut-volume-corner", .which = Old},
                    {.each = "e*(0,1,2)", .apply = "divide-bipyramid", .which = New}}};
}

} // namespace rend
