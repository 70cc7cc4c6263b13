// The elements of a preset that the simulation reads: the parameter table of bodies, world and time.
#pragma once

#include "sim/base/parameters.h"

namespace rend {

const ElementType& body_type();
const ElementType& world_type();
const ElementType& time_type();

// Of a <time> [s]. UserError where it has none and its integrator takes one: all but static do.
double duration_of(const PresetNode& time);

} // namespace rend
