// The elements of a preset that the simulation reads: the parameter table of bodies, world and time.
// What is only drawn of them (look, colours) is added by who draws (render/picture/scene_preset.cpp).
#pragma once

#include "sim/base/parameters.h"

namespace rend {

const ElementType& body_type();
const ElementType& world_type();
const ElementType& time_type();

// The duration of a <time> [s]. UserError if it has none and its integrator needs one: all but static do.
double duration_of(const PresetNode& time);

} // namespace rend
