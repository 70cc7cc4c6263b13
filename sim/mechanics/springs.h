// The springs and hinges of a body, and the material that gives them their stiffness where they have none of
// their own (thesis 2.20 to 2.22; spring_stiffness.h).
#pragma once

#include "sim/mechanics/interaction.h"

#include <string_view>

namespace rend {

struct SpringsSettings {
  std::optional<double> young = {};     // E [Pa]: stiffness by formula
  double poisson = 1.0 / 3;             // ν
  std::optional<double> thickness = {}; // [m]
  Cumulated cumulated = Cumulated::Auto;
  enum class On { All, Surface } on = On::All;
  std::vector<SpringSettings> springs = {}; // their rows follow in this order
  SettingsSource source = {};
};
template <> const Fields<SpringsSettings>& fields_of(); // those of its own

// Of all_interactions(): ("shear", "isotropic", "volume"). Where `kind` or `where` is empty: the first that
// there is. Null: there is none.
const InteractionType* find_interaction(std::string_view element, std::string_view kind = {},
                                        std::string_view where = {});

} // namespace rend
