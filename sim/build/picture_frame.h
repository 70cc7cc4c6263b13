// Where a picture lies on a body without texture coordinates: by rest positions alone, in the frame of the
// body's shape, which <place> turns, scales and moves. Nothing is stored in the map, so what tears, is cut or
// is changed by a rule keeps its picture. What is drawn (render/picture/texture_map.h) and what an expression
// reads (mechanics/element_expression.h) lie in one way.
//
//   a generated sheet  once over the sheet: u along its x, v along its y, from 0 to 1. Of a bilinear patch
//                      the (u, v) whose point is nearest; of a band u by the angle around it, and v across
//                      it, where the cells at the seam take u up to 1. The front of a band is its inside.
//   anything else      projection along x, y or z: the picture is as wide as the largest extent of the body at
//                      the start, centred, in its proportions. What is drawn takes for each face the axis
//                      that its rest normal is closest to (of two that are equally close, up to rounding: z,
//                      then x), so that it stands upright as seen from outside, or from the front of a sheet:
//                      z is up, on faces across z it is y. An expression takes for all elements the axis
//                      along which the body is thinnest, with u and v along the other two, in their order.
//
// Each mapping is affine but for bands, and corners= that span no parallelogram.
#pragma once

#include "sim/build/shape.h"
#include "sim/embedding/texture_coordinates.h"

#include <array>
#include <optional>

namespace rend {

// The frame in which pictures of a body lie: that of its shape, before <place> scales, rotates and moves it.
struct TextureFrame {
  Placement place = {};
  std::optional<SheetShape> sheet = {}; // it was made as a sheet, over which its picture is spread
};

class PictureFrame {
public:
  // map: as it is built; aspect: width / height of the picture.
  PictureFrame(const EmbeddedMap& map, const TextureFrame& frame, double aspect);

  // How a face lies in the picture. Its corners are then all mapped alike.
  struct Chart {
    int axis = 2;    // of a projection: along which, 0 to 2
    double side = 1; // 1 or -1: the face looks along it, or against it
    double turn = 0; // of a band: the angle of the face's middle [degrees]
  };
  // middle [m]: any point of the face; normal: of its front or outside, any length. Both at rest.
  Chart chart(const Vec3& middle, const Vec3& normal) const;
  Eigen::Vector2d from_middle(const Vec3& rest, const Chart& chart) const; // of the picture [m]

  TexturePlace place(const Vec3& rest) const; // that of an expression, 0 to 1; rest [m]

  bool is_spread() const { return sheet_.has_value(); } // once over a sheet
  const Eigen::Vector2d& size() const { return size_; } // of the picture [m]

private:
  Vec3 own(const Vec3& rest) const;                                    // in the shape's frame [m]
  Eigen::Vector2d on_sheet(const Vec3& own, const Chart& chart) const; // 0 to 1
  Eigen::Vector2d on_patch(const Vec3& own) const;
  Eigen::Vector2d on_band(const Vec3& own, const Chart& chart) const;
  Eigen::Vector2d on_box(const Vec3& own, const Chart& chart) const; // from its middle [m]

  std::optional<SheetShape> sheet_; // none: projection
  std::array<Vec3, 4> corners_;     // of a sheet that is no band [m]
  Eigen::Matrix3d to_own_;          // from the world's axes to the shape's
  Vec3 origin_, middle_;            // of the shape's frame in the world; of the body in that frame [m]
  Eigen::Vector2d size_;            // of the picture: width, height [m]
  Chart through_;                   // of the axis along which the body is thinnest
};

} // namespace rend
