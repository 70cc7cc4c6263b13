// Volumes of any shapes become tetrahedra that fit to each other: first a star in each face that is no
// triangle, for both of its volumes, then one in each volume that was no tetrahedron.
#include "sim/house_rules/house_scripts.h"

namespace rend {

ScriptSettings split_into_tetrahedra() {
  return {.name = "split-into-tetrahedra",
          .about = "a vertex in each face that is no triangle, and in each volume that is no tetrahedron",
          .hook = "a*(0,1,2,3)",
          .steps = {{.each = "e*(0,1,3)", .test = "size(e, face) > 3", .apply = "star-face-both-sides"},
                    {.each = "e*(0,1,2)", .test = "size(e, volume) > 4", .apply = "star-volume"}}};
}

} // namespace rend
