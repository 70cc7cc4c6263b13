#include "render/picture/still_pictures.h"

#include "render/draw/device.h"
#include "render/draw/hud.h"
#include "render/draw/renderer.h"
#include "render/picture/scene_picture.h"

#include <cmath>

namespace rend {
namespace {

// Where the curves of energies will end.
long frames_of(const Scene& scene, const ImageSettings& image) {
  return 1 + std::lround(std::min(image.playback().clip(scene.duration()) * image.fps, 1e6));
}

} // namespace

struct StillPictures::Studio {
  Studio(const PictureSettings& settings, Scene& shown)
      : scene(shown), stage(settings.image.width(), settings.image.height(), settings.image.samples),
        maker(settings, shown, settings.image.aspect(), shown.duration(), frames_of(shown, settings.image)) {}

  Scene& scene;
  std::unique_ptr<Device> device = make_device(); // before what lives in it
  Renderer stage;
  std::optional<Hud> hud; // made for the first picture that has one
  FrameBuilder maker;
  long taken = 0;
};

StillPictures::StillPictures(const PictureSettings& settings, Scene& scene) {
  check_settings(settings);
  studio_ = std::make_unique<Studio>(settings, scene);
}

StillPictures::~StillPictures() {
  studio_->device->make_current(); // OpenGL objects are freed where they are current
}

Image StillPictures::take() {
  Studio& studio = *studio_;
  studio.device->make_current();
  studio.maker.observe();
  const Frame frame = studio.maker.draw(studio.taken++, studio.scene.time());
  studio.stage.draw(frame);
  if (!frame.hud.empty() && !studio.hud) studio.hud.emplace(studio.stage.width(), studio.stage.height());
  if (studio.hud && !frame.hud.empty()) studio.hud->draw(frame.hud);
  return studio.stage.read();
}

} // namespace rend
