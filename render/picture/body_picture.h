// How one body is shown: its triangles with normals, colours and lines.
//
// A scale is the largest value so far, rounded up to 1, 2 or 5 times a power of ten; a fragment's colour is
// assigned to its smallest dart when it is first observed, so that when a fragment splits, one part keeps its
// colour. So observe() is called for every state that may be drawn (scene_picture.h).
#pragma once

#include "render/draw/frame.h"
#include "render/picture/exploded_picture.h"
#include "render/picture/laid_texture.h"
#include "render/picture/picture_settings.h"

#include <map>
#include <optional>
#include <vector>

namespace rend {

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

} // namespace rend
