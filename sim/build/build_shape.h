// The shape of a body: what it is made of cell by cell, where it is, and what it weighs.
#pragma once

#include "sim/build/body_settings.h"

namespace rend {

// Map, rest positions and mass. UserError, with its place, for what cannot be built.
void build_shape(Body& body, const BodySettings& settings);

} // namespace rend
