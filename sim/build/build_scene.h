// From a checked preset to what a scene is made of.
#pragma once

#include "sim/base/parameters.h"
#include "sim/scene/definition.h"

namespace rend {

// The bodies, the world and the time of a preset. They read from the preset for as long as they live. UserError
// where something cannot be built.
SceneDefinition read_scene(const PresetNode& preset);

} // namespace rend
