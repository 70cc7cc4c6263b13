// The change delete-element of a sheet (sim/fracture/delete_element.cpp).
#include "sim/house_rules/house_scripts.h"

namespace rend {

ScriptSettings delete_face() {
  return {.name = "delete-face",
          .about = "a face of a sheet is separated from all its neighbours and removed",
          .hook = "a*(0,1)",
          .steps = {{.each = "e*(0)", .apply = "unsew-edge", .at_least = ScriptStepSettings::AtLeast::None},
                    {.each = "e*(0,1)", .apply = "remove-isolated-face"}}};
}

} // namespace rend
