#include "render/picture/picture_settings.h"

namespace rend {

void check_settings(const PictureSettings& settings) {
  check_settings(settings.camera);
  for (const CameraKey& key : settings.camera.keys) check_settings(key);
  check_settings(settings.image);
  for (const SpeedKey& key : settings.image.speed_keys) check_settings(key);
  check_image(settings.image);
  if (settings.hud) check_settings(*settings.hud);
  if (settings.hud)
    for (const HudText& text : settings.hud->texts) check_settings(text);
  for (const LookSettings& look : settings.looks) check_settings(look);
}

} // namespace rend
