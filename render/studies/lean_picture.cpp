#include "render/studies/lean_picture.h"

#include "render/draw/device.h"
#include "render/draw/renderer.h"
#include "render/picture/scene_picture.h"
#include "render/picture/scene_preset.h"

namespace rend {

struct SmallPictures::Studio {
  std::unique_ptr<Device> device = make_device();
  Renderer renderer{320, 180, 1};
};

SmallPictures::SmallPictures() : studio_(std::make_unique<Studio>()) {}
SmallPictures::~SmallPictures() = default;

Image SmallPictures::of(const PresetNode& preset, Scene& scene) {
  Renderer& renderer = studio_->renderer;
  FrameBuilder maker(picture_settings(preset), scene, static_cast<double>(renderer.width()) / renderer.height(),
                     1, 1);
  maker.observe();
  renderer.draw(maker.draw(0, 0));
  return renderer.read();
}

} // namespace rend
