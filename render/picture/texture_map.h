// Where the picture of a body lies: the place in it of each corner of the surface.
//
// A mesh with texture coordinates (vt of .obj) has them in its map, as an embedding on corners of faces, which
// tears, cuts and rules hand on (sim/embedding/texture_coordinates.h): they are the place. A vertex that a cut
// moves takes its place along.
//
// Otherwise it follows from the rest position of the corner alone, in the frame of the body's shape, which
// <place> turns, scales and moves. So nothing is stored in the map: what tears, is cut, is changed by a rule or
// has a vertex moved keeps its picture, and a corner that is kept has the same place, bit for bit. Each mapping
// is affine (but for bands, and corners= that span no parallelogram), so that a corner born at (1 - t) a + t b
// lies there in the picture as well.
//
//   a generated sheet  once over the sheet: u along its x, v along its y, from 0 to 1. Of a bilinear patch
//                      the (u, v) whose point is nearest; of a band u by the angle around it, and v across
//                      it, where the cells at the seam take u up to 1. The front of a band is its inside.
//   anything else      box projection: a face takes the plane of x, y, z that its rest normal is closest to (of
//                      two that are equally close, up to rounding: z, then x). Seen from outside, or from the
//                      front of a sheet, it stands upright: z is up, on faces across z it is y. The picture is
//                      as wide as the largest extent of the body at the start, centred, in its proportions.
//
// Then scale and rotate act about the middle of the picture, in metres (of texture coordinates: in the
// proportions of the picture): it is turned as a whole, not sheared.
#pragma once

#include "render/draw/frame.h"
#include "render/picture/look.h"
#include "sim/body/body.h"
#include "sim/embedding/texture_coordinates.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace rend {

class TextureMap {
public:
  // body: as it is built; aspect: width / height of the picture.
  TextureMap(const Body& body, const LookSettings& look, double aspect);

  // How a face lies in the picture. Its corners are then all mapped alike.
  struct Chart {
    int axis = 2;    // of a box: the plane's, 0 to 2
    double side = 1; // 1 or -1: the face looks along it, or against it
    double turn = 0; // of a band: the angle of the face's middle [degrees]
  };
  // middle [m]: any point of the face; normal: of its front or outside, any length. Both at rest.
  Chart chart(const Vec3& middle, const Vec3& normal) const;
  TexturePlace place(const Vec3& rest, const Chart& chart) const; // [m]
  TexturePoint at(const Vec3& rest, const Chart& chart) const { return as_point(place(rest, chart)); }

  // The texture coordinates of the body; null: it has none. Then charts and rest positions are of no use.
  const Column<TextureCoordinates>* places() const { return places_; }
  TexturePlace place(const TexturePlace& given) const; // the same bits, if it is neither scaled nor turned
  TexturePoint at(const TexturePlace& given) const { return as_point(place(given)); }

  bool is_spread() const { return sheet_ || places_; } // over a sheet, so that each picture covers it alike
  bool is_spread_once() const;                         // over one that was made, and neither scaled nor turned

private:
  // A file may name any number: what is that far away is no place in a picture that could be seen.
  static TexturePoint as_point(const TexturePlace& place) {
    const auto within = [](double x) {
      return std::isfinite(x) ? static_cast<float>(std::clamp(x, -1e9, 1e9)) : 0.5f;
    };
    return {within(place.u), within(place.v)};
  }
  bool is_plain() const { return scale_ == Eigen::Vector2d::Ones() && sine_ == 0 && cosine_ == 1; }
  TexturePlace in_picture(const Eigen::Vector2d& from_middle) const;   // [m]
  Vec3 own(const Vec3& rest) const;                                    // in the shape's frame [m]
  Eigen::Vector2d on_sheet(const Vec3& own, const Chart& chart) const; // 0 to 1
  Eigen::Vector2d on_patch(const Vec3& own) const;
  Eigen::Vector2d on_band(const Vec3& own, const Chart& chart) const;
  Eigen::Vector2d on_box(const Vec3& own, const Chart& chart) const; // from its middle [m]

  const Column<TextureCoordinates>* places_;
  std::optional<SheetShape> sheet_; // none: box projection, or texture coordinates
  std::array<Vec3, 4> corners_;     // of a sheet that is no band [m]
  Eigen::Matrix3d to_own_;          // from the world's axes to the shape's
  Vec3 origin_, middle_;            // of the shape's frame in the world; of the body in that frame [m]
  Eigen::Vector2d size_;            // of the picture: width, height [m]; of texture coordinates: aspect, 1
  Eigen::Vector2d scale_;           // factors of it
  double cosine_ = 1, sine_ = 0;    // of the angle by which it is turned
};

} // namespace rend
