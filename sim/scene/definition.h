// What a scene is made of: built bodies, what surrounds them, and how time goes. sim/build makes one from a
// preset; a program may fill one by itself.
#pragma once

#include "sim/base/error.h"
#include "sim/body/body.h"
#include "sim/outside/world.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rend {

struct TimeSettings {
  const Scheme* scheme = find_scheme("symplectic");
  std::optional<double> step;      // [s]; none: 0.9 of what is stable
  std::optional<double> tolerance; // of rk45, which chooses its steps by it; none: SchemeSettings' own
  double duration = 0;             // [s]

  // Where the settings stand in the user's file, for messages; empty: nowhere.
  Place step_place, integrator_place, tolerance_place;
};

struct SceneDefinition {
  std::string name = "scene";
  World world;
  std::vector<std::unique_ptr<Body>> bodies; // declared, and not yet prepared; their names differ
  TimeSettings time;
  double build_seconds = 0; // wall clock, that building the bodies took
};

} // namespace rend
