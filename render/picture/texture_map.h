// Where the picture of a body lies: the place in it of each corner of the surface.
//
// A mesh with texture coordinates (vt of .obj) has them in its map, as an embedding on corners of faces, which
// tears, cuts and rules hand on (sim/embedding/texture_coordinates.h): they are the place. A vertex that a cut
// moves takes its place along.
//
// Otherwise it follows from the rest position of the corner alone, in the frame of the body's shape: once over
// a generated sheet, else by box projection (sim/build/picture_frame.h). So nothing is stored in the map: what
// tears, is cut, is changed by a rule or has a vertex moved keeps its picture, and a corner that is kept has
// the same place, bit for bit. A corner born at (1 - t) a + t b lies there in the picture as well, where the
// mapping is affine.
//
// Then scale and rotate act about the middle of the picture, in metres (of texture coordinates: in the
// proportions of the picture): it is turned as a whole, not sheared.
#pragma once

#include "render/draw/frame.h"
#include "render/picture/look.h"
#include "sim/body/body.h"
#include "sim/build/picture_frame.h"
#include "sim/embedding/texture_coordinates.h"

#include <algorithm>
#include <cmath>

namespace rend {

class TextureMap {
public:
  // body: as it is built; aspect: width / height of the picture.
  TextureMap(const Body& body, const LookSettings& look, double aspect);

  using Chart = PictureFrame::Chart; // how a face lies in the picture
  // middle [m]: any point of the face; normal: of its front or outside, any length. Both at rest.
  Chart chart(const Vec3& middle, const Vec3& normal) const { return frame_.chart(middle, normal); }
  TexturePlace place(const Vec3& rest, const Chart& chart) const; // [m]
  TexturePoint at(const Vec3& rest, const Chart& chart) const { return as_point(place(rest, chart)); }

  // The texture coordinates of the body; null: it has none. Then charts and rest positions are of no use.
  const Column<TextureCoordinates>* places() const { return places_; }
  TexturePlace place(const TexturePlace& given) const; // the same bits, if it is neither scaled nor turned
  TexturePoint at(const TexturePlace& given) const { return as_point(place(given)); }

  bool is_spread() const {
    return frame_.is_spread() || places_;
  } // over a sheet, so that each picture covers it alike
  // Over one that was made, and neither scaled nor turned.
  bool is_spread_once() const { return frame_.is_spread() && is_plain(); }

private:
  // A file may name any number: what is that far away is no place in a picture that could be seen.
  static TexturePoint as_point(const TexturePlace& place) {
    const auto within = [](double x) {
      return std::isfinite(x) ? static_cast<float>(std::clamp(x, -1e9, 1e9)) : 0.5f;
    };
    return {within(place.u), within(place.v)};
  }
  bool is_plain() const { return scale_ == Eigen::Vector2d::Ones() && sine_ == 0 && cosine_ == 1; }
  TexturePlace in_picture(const Eigen::Vector2d& from_middle) const; // [m]

  const Column<TextureCoordinates>* places_;
  PictureFrame frame_;           // where the body has no texture coordinates
  Eigen::Vector2d size_;         // of the picture: width, height [m]; of texture coordinates: aspect, 1
  Eigen::Vector2d scale_;        // factors of it
  double cosine_ = 1, sine_ = 0; // of the angle by which it is turned
};

} // namespace rend
