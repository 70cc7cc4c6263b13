// The change delete-edge of a solid (sim/fracture/delete_edge.cpp).
#include "sim/house_rules/house_scripts.h"

namespace rend {

ScriptSettings delete_volumes_at_edge() {
  return {.name = "delete-volumes-at-edge",
          .about = "the volumes at an edge are removed",
          .hook = "a*(0,2,3)",
          .steps = {{.each = "e*(0,1,2)", .apply = "delete-volume"}}};
}

} // namespace rend
