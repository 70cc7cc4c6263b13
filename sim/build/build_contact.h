// What a body does not pass through.
#pragma once

#include "sim/build/body_settings.h"
#include "sim/outside/world.h"

namespace rend {

// On a body that has its shape. UserError, with its place, for what the world does not have.
void build_contact(Body& body, const BodySettings& settings, const World& world);

} // namespace rend
