#include "render/studies/lean_picture.h"

#include "render/draw/device.h"
#include "render/draw/stage.h"
#include "render/picture/scene_picture.h"
#include "render/picture/scene_preset.h"

namespace rend {

struct SmallPictures::Studio {
  std::unique_ptr<Device> device = make_device();
  Stage stage{320, 180, 1};
};

SmallPictures::SmallPictures() : studio_(std::make_unique<Studio>()) {}
SmallPictures::~SmallPictures() = default;

Image SmallPictures::of(const PresetNode& preset, Scene& scene) {
  Stage& stage = studio_->stage;
  PictureMaker maker(picture_settings(preset), scene, static_cast<double>(stage.width()) / stage.height(), 1,
                     1);
  maker.observe();
  stage.draw(maker.draw(0, 0));
  return stage.read();
}

} // namespace rend
