// The change delete-edge of a sheet (sim/fracture/delete_edge.cpp).
#include "sim/house_rules/house_scripts.h"

namespace rend {

ScriptSettings delete_faces_at_edge() {
  return {.name = "delete-faces-at-edge",
          .about = "the faces of a sheet at an edge are removed",
          .hook = "a*(0,2)",
          .steps = {{.each = "e*(0,1)", .apply = "delete-face"}}};
}

} // namespace rend
