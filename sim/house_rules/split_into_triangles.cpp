// A star in each face of a sheet.
#include "sim/house_rules/house_scripts.h"

namespace rend {

ScriptSettings split_into_triangles() {
  return {.name = "split-into-triangles",
          .about = "a vertex in the middle of each face of a sheet, and a triangle from it to each side",
          .hook = "a*(0,1,2)",
          .steps = {{.each = "e*(0,1)", .apply = "star-face"}}};
}

} // namespace rend
