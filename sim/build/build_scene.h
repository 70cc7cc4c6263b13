// What a scene is made of: from settings that a program fills in, or from a checked preset.
#pragma once

#include "sim/base/parameters.h"
#include "sim/build/body_settings.h"
#include "sim/scene/definition.h"

#include <filesystem>
#include <functional>
#include <memory>

namespace rend {

// Builds a body among what surrounds it, which is set before. UserError, with its place where there is one, for
// what cannot be built, and where two bodies or two probes have the same name.
Body& add_body(SceneDefinition& scene, const BodySettings& settings);

// Whether a body keeps the texture coordinates of its mesh file (MeshSettings).
using TextureChoice = std::function<bool(const PresetNode& body)>;

// Reads the picture of an expression. UserError: there is no such picture.
using MaskReader = std::function<std::shared_ptr<const Mask>(const std::filesystem::path& file)>;

// What a scene takes from pictures, which this library cannot read.
struct ScenePictures {
  TextureChoice is_textured = {}; // empty: no body is, but where an expression asks for texture coordinates
  MaskReader read_mask = {};      // empty: expressions with a picture are refused
};

// The bodies, the world and the time of a preset. They read from the preset for as long as they live.
// UserError where something cannot be built.
SceneDefinition read_scene(const PresetNode& preset, const ScenePictures& pictures = {});

} // namespace rend
