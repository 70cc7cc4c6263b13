// From the <contact> of a checked preset to what a body does not pass through.
#pragma once

#include "sim/body/body.h"
#include "sim/outside/world.h"

namespace rend {

const ElementType& contact_type(); // <contact>, as the parameter table has it

// UserError, with its place, where the world has nothing to be in contact with.
void build_contact(Body& body, const PresetNode& node, const World& world);

} // namespace rend
