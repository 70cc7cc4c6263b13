// All that decides how a scene is drawn, and nothing of how it moves. A preset says it in <camera>, <image>,
// <hud>, in the <look> of each body and the colours of obstacles (scene_preset.h); a program fills in what it
// wants otherwise than by default.
#pragma once

#include "render/picture/camera_settings.h"
#include "render/picture/hud_writer.h"
#include "render/picture/image_settings.h"
#include "render/picture/look.h"
#include "render/picture/obstacle_picture.h"

#include <optional>
#include <vector>

namespace rend {

struct PictureSettings {
  CameraSettings camera = {};
  ImageSettings image = {};
  std::optional<HudSettings> hud = {}; // none: nothing is written over the pictures
  // Of the scene's bodies, spheres, boxes and meshes, in their order. Those that a list does not reach look
  // as by default.
  std::vector<LookSettings> looks = {};
  std::vector<SphereLook> spheres = {};
  std::vector<BoxLook> boxes = {};
  std::vector<MeshLook> meshes = {};
};

// For settings that a program made, which no reader has looked at. UserError: a number that is not finite or
// out of its bounds.
void check_settings(const PictureSettings& settings);

} // namespace rend
