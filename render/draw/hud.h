// The head-up display: writes HudContent over the picture that was drawn, with Dear ImGui.
//
// Only ImGui's draw lists are used, not its windows: positions and sizes are fractions of the picture's height,
// and the font is rasterized at the size at which it is drawn, so that text is crisp and the layout is the same
// at any size.
//
// A Device must be current, from construction to destruction; one Hud at a time in a thread.
#pragma once

#include "render/draw/hud_content.h"

#include <memory>

namespace rend {

// False if rend was built without REND_HUD: a Hud then draws nothing.
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
