// Makes a Frame from the state of a scene: triangles with normals, colours and lines; obstacles; the floor; the
// camera.
//
// Colours that depend on a scale or an order must not flicker, and a frame drawn alone must equal the same
// frame of the whole clip. So observe() is called for every frame of the clip, drawn or not: a scale is the
// largest value so far, rounded up to 1, 2 or 5 times a power of ten; and a fragment's colour is assigned to
// its smallest dart when it is first observed, so that when a fragment splits, one part keeps its colour. With
// motion blur the states of all its moments are observed likewise, drawn or not.
#pragma once

#include "render/draw/frame.h"
#include "render/picture/exploded_picture.h"
#include "render/picture/laid_texture.h"
#include "render/picture/picture_settings.h"
#include "render/picture/viewpoint.h"

#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace rend {

// How one body is shown.
class BodyPicture {
public:
  // UserError: darts of a body that has too many to be drawn
  BodyPicture(Body& body, LookSettings look, const LookTextures& textures);

  void observe(std::size_t& fragments_seen); // counts the fragments of all bodies that have a colour
  // Appends the state that was observed to `out`: of a solid with textures or two finishes its outside and what
  // fracture exposes, one after the other, of a sheet with a thickness its front, its back and its rim; of any
  // other body one.
  void draw(std::vector<FrameBody>& out);
  std::optional<HudLegend> legend() const; // none where colours show no quantity, or nothing is known of it yet
  std::size_t bytes() const;               // of its surface
  std::size_t fragments_seen() const { return colour_numbers_.size(); } // of this body
  void store(Archive& archive);                                         // scale and colours so far; checkpoint

private:
  FrameBody plain() const;                         // without corners
  void draw_as_it_is(std::vector<FrameBody>& out); // with straight triangles
  void find_normals();
  // raised [m]: along the normals
  void draw_faces(FrameBody& out, DrawnFaces which, double raised);
  void draw_thick_sheet(std::vector<FrameBody>& out);
  Colour rim_colour(bool torn) const;
  void label_fragments(std::size_t& fragments_seen);
  void colour_vertices();
  TornLine torn_line() const;
  Colour colour_at(const CellCorner& at) const;

  Body* body_;
  LookSettings look_;
  bool solid_ = false, orientable_ = true;
  LaidTexture texture_;
  double scale_ = 0;          // the quantity at the end of the colours; what look_.most says, or seen so far
  std::vector<Vec3> normals_; // unit or 0, one per vertex slot (of a solid: per corner of a drawn face)
  std::vector<Vec3> normal_sums_;                       // scratch memory
  std::vector<double> values_;                          // of strain or force, one per vertex slot
  std::vector<Colour> vertex_colours_;                  // one per vertex slot; empty unless by strain or force
  std::vector<std::uint32_t> labels_;                   // fragment of each dart; empty unless by fragment
  std::vector<Colour> fragment_colours_;                // one per label
  std::map<std::uint32_t, std::size_t> colour_numbers_; // smallest dart of a fragment → number of its colour
};

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
