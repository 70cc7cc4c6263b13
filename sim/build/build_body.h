// From the settings of a body to a body: its map, what moves it, where it tears, what is measured on it.
#pragma once

#include "sim/build/body_settings.h"
#include "sim/outside/world.h"

#include <memory>

namespace rend {

// Declared, and not yet prepared. The settings need not live longer. UserError, with its place where there is
// one, for what cannot be built.
std::unique_ptr<Body> build_body(const BodySettings& settings, const World& world);

} // namespace rend
