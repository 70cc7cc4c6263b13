// The whole parameter table: the root <scene>, with what the simulation reads (sim/build/scene_types.h) and
// what pictures are made by.
#pragma once

#include "sim/preset/preset_reader.h"

#include <array>
#include <memory>
#include <span>
#include <string>

namespace rend {

const ElementType& scene_type();

// Reads a preset, checked against the table. Its name must do as a file name, since pictures are called by it.
// Throws UserError as read_preset does.
std::unique_ptr<PresetNode> load_scene(const std::filesystem::path& path,
                                       std::span<const Override> overrides = {});

// The same for a text; `file` is what its places are called by.
std::unique_ptr<PresetNode> load_scene_text(std::string_view text, const std::string& file,
                                            std::span<const Override> overrides = {});

// What <image> says, or the table where it is silent or absent.
struct ImageSettings {
  int width = 0, height = 0;                // [pixels]
  double fps = 0;                           // [1/s]
  int samples = 0;                          // a pixel
  std::array<std::uint8_t, 3> background{}; // sRGB
  bool transparent = false;                 // there is no background
  bool occlusion = true;                    // ambient occlusion
};
ImageSettings image_settings(const PresetNode& scene);

} // namespace rend
