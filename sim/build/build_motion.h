// What moves a body: the velocity that it starts with, fixed and driven vertices, and loads.
#pragma once

#include "sim/build/body_settings.h"

namespace rend {

// On a body that has its shape and its mass. UserError, with its place, for what cannot be built.
void build_motion(Body& body, const BodySettings& settings);

} // namespace rend
