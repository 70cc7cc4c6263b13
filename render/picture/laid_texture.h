// The pictures on a body, as they lie on the triangles that are drawn of it: each corner has its place in one.
//
// Where a mesh has texture coordinates they are the place, found by the corner's dart. Otherwise it follows
// from the rest position of the corner and the chart that its face lies in (texture_map.h), one for the whole
// face.
#pragma once

#include "render/draw/frame.h"
#include "render/picture/look.h"
#include "render/picture/texture_file.h"
#include "render/picture/texture_map.h"

#include <optional>

namespace rend {

// Whether its pictures are seen: where colours show something else, or no sides are drawn, none are.
bool shows_pictures(const LookSettings& look);

// Which faces of a body: a solid with pictures is drawn in two parts, since each has its own.
enum class DrawnFaces { All, Outer, Exposed };

inline bool is_drawn(DrawnFaces which, bool exposed) {
  return which == DrawnFaces::All || exposed == (which == DrawnFaces::Exposed);
}

class LaidTexture {
public:
  // body: as it is built; it outlives this. textures: those that are seen.
  LaidTexture(Body& body, const LookSettings& look, const LookTextures& textures);

  bool any() const { return outside_ || inside_; }
  bool covers_front() const { return outside_ && outside_->texture.front; }

  // To what is drawn of these faces, triangle by triangle as the boundary of the body has them.
  void lay(FrameBody& out, DrawnFaces which) const;

private:
  struct Layer {
    FrameTexture texture;
    TextureMap map;
  };
  static std::optional<Layer> layer(const Body& body, const LookSettings& look, const Texture* leading,
                                    FrameTexture texture);
  void lay_by_coordinates(const Layer& layer, FrameBody& out, DrawnFaces which) const;
  void lay_by_charts(const Layer& layer, FrameBody& out, DrawnFaces which) const;

  Body* body_;
  std::optional<Layer> outside_; // of a sheet: both sides
  std::optional<Layer> inside_;  // of a solid: what fracture exposes
};

} // namespace rend
