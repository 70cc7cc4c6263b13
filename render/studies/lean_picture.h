// Renders small pictures of states, to compare them bit by bit.
#pragma once

#include "render/files/image.h"
#include "sim/scene/scene.h"

#include <memory>

namespace rend {

class SmallPictures {
public:
  SmallPictures(); // starts OpenGL
  ~SmallPictures();
  Image of(const PresetNode& preset, Scene& scene);

private:
  struct Studio;
  std::unique_ptr<Studio> studio_;
};

} // namespace rend
