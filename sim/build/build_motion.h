// What moves a body from outside: fixed and driven vertices, and loads.
#pragma once

#include "sim/build/body_settings.h"

namespace rend {

// On a body that has its shape. UserError, with its place, for what cannot be built.
void build_motion(Body& body, const BodySettings& settings);

} // namespace rend
