// A layer of volumes around a body: one on each face of its hull, sewn to each other at the hull's edges. How
// many volumes lie around such an edge inside does not matter: the two new sides there are the only open
// ones.
#include "sim/house_rules/house_scripts.h"

namespace rend {

ScriptSettings extrude_hull() {
  using S = ScriptStepSettings;
  return {.name = "extrude-hull",
          .about = "a volume on each face of the hull; the body grows by a share t, as seen from its middle",
          .hook = "a*(0,1,2,3)",
          .steps =
              {{.each = "e*(0,1)",
                .test = "free(e, 3)",
                .apply = "extrude-away",
                .arguments = {{"centre", "mean(a, component)"}, {"t", "t"}}},
               {.each = "e*(2,3)", .apply = "sew-faces", .which = S::Which::Old, .at_least = S::AtLeast::None}},
          .wheres = {{.name = "t", .value = "0.2"}}};
}

} // namespace rend
