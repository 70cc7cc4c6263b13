// The pictures on the bodies and obstacles of a scene, for exports: which files, and where each corner of the
// surface lies in them. Whoever draws the scene knows them (render/clip/picture_on_skin.h).
#pragma once

#include "sim/embedding/texture_coordinates.h"

#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace rend {

// What faces are covered with.
struct SkinMaterial {
  std::array<double, 3> colour{1, 1, 1}; // 0 to 1, as in the preset; with a picture of no use
  std::string picture;                   // a file, as exported files name it; empty: none
};

struct SkinPicture { // of one body or obstacle
  SkinMaterial outside;
  SkinMaterial exposed; // of the faces of a solid that fracture exposed
  // Appends the place of each corner of a face, which has these darts in the order of its walk: of a solid
  // counter-clockwise from outside, of a sheet either way. Asked only for faces with a picture.
  std::function<void(std::span<const Dart> corners, bool exposed, std::vector<TexturePlace>& out)> lay;

  const SkinMaterial& material(bool is_exposed) const { return is_exposed ? exposed : outside; }
};

// One per body, then one per sphere, then one per box; empty: no body has a picture, and none is exported.
using SkinPictures = std::vector<SkinPicture>;

} // namespace rend
