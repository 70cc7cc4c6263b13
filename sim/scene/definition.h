// The definition of a scene: built bodies, their surroundings, and time settings. sim/build makes one from a
// preset; a program may fill one itself.
#pragma once

#include "sim/base/settings.h"
#include "sim/body/body.h"
#include "sim/outside/world.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rend {

struct TimeSettings {
  std::optional<double> step = {}; // [s]; none: 0.9 of what is stable
  const Scheme* scheme = find_scheme("symplectic");
  double tolerance = SchemeSettings{}.tolerance;       // of rk45, which chooses its steps by it
  double rho_infinity = SchemeSettings{}.rho_infinity; // of alpha, 0 to 1
  std::optional<double> duration = {};                 // [s]
  std::optional<double> mass_scaling =
      {}; // the largest share of a body's mass to add (mass_scaling.h); none: 0
  SettingsSource source = {};
};
template <> const Fields<TimeSettings>& fields_of();

// [s]. UserError where there is none and the scheme takes one: all but static do.
double duration_of(const TimeSettings& time);

struct SceneDefinition {
  std::string name = "scene";
  World world;
  std::vector<std::unique_ptr<Body>> bodies; // complete but not yet prepared; their names differ
  TimeSettings time;
  double build_seconds = 0; // wall clock, for building the bodies
};

} // namespace rend
