// The whole parameter table: the root <scene>, with what the simulation reads (sim/build/scene_types.h) and
// what pictures need.
#pragma once

#include "render/picture/picture_settings.h"
#include "sim/build/build_scene.h"
#include "sim/preset/preset_reader.h"

#include <memory>
#include <span>
#include <string>

namespace rend {

const ElementType& scene_type();

// Reads a preset and checks it against the table. Its name must be valid as a file name, since outputs are
// named after it. Throws UserError as read_preset does.
std::unique_ptr<PresetNode> load_scene(const std::filesystem::path& path,
                                       std::span<const Override> overrides = {});

// The same for a text; `file` is the file name in error messages.
std::unique_ptr<PresetNode> load_scene_text(std::string_view text, const std::string& file,
                                            std::span<const Override> overrides = {});

// Whether pictures lie on the outside of a body, by its <look>.
bool has_texture(const PresetNode& body);

// What the simulation takes from pictures: read_scene(preset, scene_pictures()).
ScenePictures scene_pictures();

// What a scene that was loaded here says of its pictures. Messages about it read from the scene for as long as
// they may come.
PictureSettings picture_settings(const PresetNode& scene);

} // namespace rend
