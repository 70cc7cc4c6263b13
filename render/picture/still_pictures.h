// Pictures of a scene as it is, in memory: for a program that steps a scene by itself.
//
//   StillPictures pictures(settings, scene);
//   while (scene.time() < scene.duration()) scene.step();
//   write_png("torn.png", pictures.take()); // render/files/png.h
//
// One is a Device, a Stage and a FrameBuilder, which a program may also use one by one: to draw many sizes, or
// to hand frames to a Pipeline, which draws and writes while the simulation goes on
// (render/pipeline/pipeline.h).
#pragma once

#include "render/files/image.h"
#include "render/picture/picture_settings.h"
#include "sim/scene/scene.h"

#include <memory>

namespace rend {

class StillPictures {
public:
  // Starts off-screen OpenGL, and sets the environment for it (make_device()); all calls are to come from one
  // thread. The camera is fitted to the scene as it is
  // now, and turns or follows until the scene's duration; the scene must live as long as this. UserError: the
  // camera looks at nothing (BadInput); a size, or a number of samples, that cannot be drawn (BadInput); no
  // OpenGL here (CannotCreate), or no memory for it (OutOfBudget).
  StillPictures(const PictureSettings& settings, Scene& scene);
  ~StillPictures();
  StillPictures(const StillPictures&) = delete;
  StillPictures& operator=(const StillPictures&) = delete;

  // The picture of the present state: RGB, or RGBA without a background. Scales of colours are those of the
  // pictures so far (scene_picture.h).
  Image take();

private:
  struct Studio;
  std::unique_ptr<Studio> studio_;
};

} // namespace rend
