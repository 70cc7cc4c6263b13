// The matter of a body: springs, a continuum, ambient viscosity.
#pragma once

#include "sim/build/body_settings.h"

namespace rend {

// On a body that has its shape. UserError, with its place, for what cannot be built.
void build_matter(Body& body, const BodySettings& settings);

} // namespace rend
