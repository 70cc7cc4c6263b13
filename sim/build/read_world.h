// Builds the surroundings of the bodies from the <world> of a checked preset.
#pragma once

#include "sim/base/parameters.h"
#include "sim/outside/world.h"

namespace rend {

const ElementType& world_type(); // <world> in the parameter table

// Of obstacles that move.
const ElementType& key_type();
std::vector<ObstacleKey> read_keys(const PresetNode& obstacle);

// It reads from the node for as long as it lives. UserError, with its place, for what cannot be built.
World read_world(const PresetNode* node); // null: the preset says nothing of it

} // namespace rend
