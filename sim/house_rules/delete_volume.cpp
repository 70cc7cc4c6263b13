// The change delete-element of a solid (sim/fracture/delete_element.cpp).
#include "sim/house_rules/house_scripts.h"

namespace rend {

ScriptSettings delete_volume() {
  return {.name = "delete-volume",
          .about = "a volume is separated from all its neighbours and removed (thesis fig. 7.7)",
          .hook = "a*(0,1,2)",
          .steps = {{.each = "e*(0,1)", .apply = "unsew-face", .at_least = ScriptStepSettings::AtLeast::None},
                    {.each = "e*(0,1,2)", .apply = "remove-isolated-volume"}}};
}

} // namespace rend
