// Makes a Frame from the state of a scene: triangles with normals, colours and lines; obstacles; the floor; the
// camera.
//
// Colours that depend on a scale or an order must not flicker, and a frame drawn alone must equal the same
// frame of the whole clip. So observe() is called for every frame of the clip, drawn or not: a scale is the
// largest value so far, rounded up to 1, 2 or 5 times a power of ten; and a fragment's colour is assigned to
// its smallest dart when it is first observed, so that when a fragment splits, one part keeps its colour. With
// motion blur the states of all its moments are observed likewise, drawn or not.
#pragma once

#include "render/picture/body_picture.h"
#include "render/picture/viewpoint.h"

#include <memory>
#include <optional>
#include <vector>

namespace rend {

class FrameBuilder {
public:
  // aspect: width / height; duration [s] and frames of the clip. UserError where the camera looks at nothing.
  FrameBuilder(const PictureSettings& settings, Scene& scene, double aspect, double duration, long frames);

  void observe(); // call with the state of each frame
  Frame draw(long number,
             double time); // `time` [s] of the frame, for the camera; call observe() first
  // For motion blur: call observe_moment() with the states of its moments (FrameClock::moments_of), then
  // state() for those that are drawn; draw_without_bodies() then makes the rest of the frame.
  void observe_moment();
  FrameState state();
  Frame draw_without_bodies(long number, double time);
  FrameCamera camera(double time) const { return viewpoint_.at(time); }
  std::size_t bytes() const;                  // of surfaces
  double seconds() const { return seconds_; } // spent in observe() and draw()
  void store(Archive& archive);               // scales and colours of the frames so far; checkpoint

private:
  std::vector<HudLegend> legends() const;
  Scene& scene_;
  Viewpoint viewpoint_;
  ImageSettings image_;
  std::vector<SphereLook> spheres_; // one each
  std::vector<BoxLook> boxes_;
  std::vector<FrameBody> meshes_; // as the preset puts them
  std::vector<std::unique_ptr<BodyPicture>> bodies_;
  std::optional<HudWriter> hud_; // none: the preset has no HUD
  std::size_t fragments_seen_ = 0;
  double seconds_ = 0;
};

} // namespace rend
