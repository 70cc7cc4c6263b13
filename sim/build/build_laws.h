// Where a body tears.
#pragma once

#include "sim/build/body_settings.h"

namespace rend {

// Laws of tearing, on a body that has its interactions. UserError, with its place, for what cannot be built.
void build_laws(Body& body, const BodySettings& settings);

} // namespace rend
