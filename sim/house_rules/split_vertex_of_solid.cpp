// The change split-vertex of a solid (sim/fracture/split_vertex.cpp).
#include "sim/house_rules/house_scripts.h"

namespace rend {

ScriptSettings split_vertex_of_solid() {
  return {.name = "split-vertex-of-solid",
          .about = "the volumes at a vertex part where the plane across the force runs between them",
          .hook = "a*(1,2,3)",
          .steps = {{.each = "e*(0,1,3)",
                     .apply = "part-volumes",
                     .at_least = ScriptStepSettings::AtLeast::None,
                     .arguments = {{"origin", "a"}, {"n", "across"}}}}};
}

} // namespace rend
