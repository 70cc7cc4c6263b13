// The head-up display: writes HudContent over the picture that was drawn, with Dear ImGui.
//
// Only ImGui's lists of shapes and text are used, none of its windows: places and sizes are shares of the
// picture's height, and the font is baked at the size it is drawn at, so that it is crisp and laid out alike at
// any size.
//
// A Device must be current, from construction to destruction; one Hud at a time in a thread.
#pragma once

#include "render/draw/hud_content.h"

#include <memory>

namespace rend {

// False where rend was built without REND_HUD: a Hud then draws nothing.
bool hud_available();

class Hud {
public:
  Hud(int width, int height); // [pixels]
  ~Hud();
  Hud(const Hud&) = delete;
  Hud& operator=(const Hud&) = delete;

  void draw(const HudContent& content); // onto the bound framebuffer

private:
  struct Context;
  std::unique_ptr<Context> context_;
};

} // namespace rend
