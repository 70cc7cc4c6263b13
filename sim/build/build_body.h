// From the <body> of a checked preset to a body.
#pragma once

#include "sim/body/body.h"
#include "sim/outside/world.h"

namespace rend {

// UserError, with its place, for what cannot be built. The body is not prepared yet.
std::unique_ptr<Body> build_body(const PresetNode& node, const World& world);

} // namespace rend
