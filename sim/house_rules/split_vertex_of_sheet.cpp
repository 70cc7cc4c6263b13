// The change split-vertex of a sheet (sim/fracture/split_vertex.cpp).
#include "sim/house_rules/house_scripts.h"

namespace rend {

ScriptSettings split_vertex_of_sheet() {
  return {.name = "split-vertex-of-sheet",
          .about = "the faces at a vertex part where the plane across the force runs between them",
          .hook = "a*(1,2)",
          .steps = {{.each = "e*(0,2)",
                     .apply = "part-faces",
                     .at_least = ScriptStepSettings::AtLeast::None,
                     .arguments = {{"origin", "a"}, {"n", "across"}}}}};
}

} // namespace rend
