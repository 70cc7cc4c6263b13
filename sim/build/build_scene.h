// What a scene is made of: from settings that a program fills in, or from a checked preset.
#pragma once

#include "sim/base/parameters.h"
#include "sim/build/body_settings.h"
#include "sim/scene/definition.h"

#include <functional>

namespace rend {

// Builds a body among what surrounds it, which is set before. UserError, with its place where there is one, for
// what cannot be built, and where two bodies or two probes have the same name.
Body& add_body(SceneDefinition& scene, const BodySettings& settings);

// Whether a body keeps the texture coordinates of its mesh file (MeshSettings).
using TextureChoice = std::function<bool(const PresetNode& body)>;

// The bodies, the world and the time of a preset. They read from the preset for as long as they live. No body
// keeps texture coordinates unless it is chosen. UserError where something cannot be built.
SceneDefinition read_scene(const PresetNode& preset, const TextureChoice& is_textured = {});

} // namespace rend
