#include "sim/build/picture_frame.h"

#include "sim/base/math.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

using Eigen::Vector2d;

constexpr double tie = 1e-6; // components of normals that differ by less are equal, up to rounding

std::array<Vec3, 4> corners_of(const SheetShape& sheet) {
  if (sheet.corners) return *sheet.corners;
  const auto [lx, ly] = sheet.size.value_or(std::array<double, 2>{1, 1});
  return {Vec3(0, 0, 0), Vec3(lx, 0, 0), Vec3(lx, ly, 0), Vec3(0, ly, 0)};
}

bool is_band(const SheetShape& sheet) {
  return sheet.closure != SheetClosure::None;
}

// The axis along which a box is thinnest; of two that are equally thin, up to rounding: z, then x. u and v go
// along the other two, in their order.
PictureFrame::Chart chart_through(const Vec3& sizes) {
  PictureFrame::Chart chart;
  const double least = sizes.minCoeff() + tie * sizes.maxCoeff();
  for (const int axis : {1, 0, 2})
    if (sizes[axis] <= least) chart.axis = axis;
  chart.side = chart.axis == 1 ? -1 : 1;
  return chart;
}

} // namespace

PictureFrame::PictureFrame(const EmbeddedMap& map, const TextureFrame& frame, double aspect) {
  std::vector<Vec3> axes_of_shape{Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  frame.place.apply(axes_of_shape);
  origin_ = axes_of_shape[0];
  Eigen::Matrix3d axes; // a rotation times the scale
  axes << axes_of_shape[1] - origin_, axes_of_shape[2] - origin_, axes_of_shape[3] - origin_;
  to_own_ = axes.transpose() / (frame.place.scale * frame.place.scale);
  middle_ = Vec3::Zero();
  if (map.dimension() == 2) sheet_ = frame.sheet;
  if (sheet_) {
    corners_ = corners_of(*sheet_);
    const auto& c = corners_;
    size_ = is_band(*sheet_) ? Vector2d((*sheet_->size)[0], (*sheet_->size)[1])
                             : 0.5 * Vector2d((c[1] - c[0]).norm() + (c[2] - c[3]).norm(),
                                              (c[3] - c[0]).norm() + (c[2] - c[1]).norm());
    return;
  }
  Eigen::AlignedBox3d box;
  const CellIndex& vertices = map.cells(Vertex);
  for (Slot v = 0; v < vertices.slots(); ++v)
    if (vertices.alive(v)) box.extend(own(map.rest()[v].vec()));
  if (!box.isEmpty()) middle_ = box.center();
  const double extent = box.isEmpty() ? 1 : box.sizes().maxCoeff();
  size_ = Vector2d(extent, extent / aspect);
  if (!box.isEmpty()) through_ = chart_through(box.sizes());
}

Vec3 PictureFrame::own(const Vec3& rest) const {
  return to_own_ * (rest - origin_);
}

PictureFrame::Chart PictureFrame::chart(const Vec3& middle, const Vec3& normal) const {
  Chart chart;
  if (sheet_) {
    const Vec3 at = own(middle);
    if (is_band(*sheet_)) chart.turn = arc_tangent(at.x(), -at.z()) * 180 / pi;
    if (chart.turn < 0) chart.turn += 360;
    return chart;
  }
  const Vec3 across = to_own_ * normal;
  const double most = (1 - tie) * across.cwiseAbs().maxCoeff();
  for (const int axis : {1, 0, 2})
    if (std::abs(across[axis]) >= most) chart.axis = axis;
  chart.side = across[chart.axis] < 0 ? -1 : 1;
  return chart;
}

Vector2d PictureFrame::from_middle(const Vec3& rest, const Chart& chart) const {
  const Vec3 here = own(rest);
  if (!sheet_) return on_box(here, chart);
  return (on_sheet(here, chart) - Vector2d(0.5, 0.5)).cwiseProduct(size_);
}

TexturePlace PictureFrame::place(const Vec3& rest) const {
  const Vec3 here = own(rest);
  const Vector2d at = sheet_ ? on_sheet(here, chart(rest, Vec3::Zero()))
                             : Vector2d(on_box(here, through_).cwiseQuotient(size_) + Vector2d(0.5, 0.5));
  return {at.x(), at.y()};
}

// Upright as seen from outside: to the right of who looks against the face's normal, and up.
Vector2d PictureFrame::on_box(const Vec3& own, const Chart& chart) const {
  const Vec3 from = own - middle_;
  switch (chart.axis) {
  case 0:
    return {chart.side * from.y(), from.z()};
  case 1:
    return {-chart.side * from.x(), from.z()};
  default:
    return {chart.side * from.x(), from.y()};
  }
}

Vector2d PictureFrame::on_sheet(const Vec3& own, const Chart& chart) const {
  return is_band(*sheet_) ? on_band(own, chart) : on_patch(own);
}

// The nearest point of the bilinear patch, by Gauss and Newton: exact after one step on a parallelogram.
Vector2d PictureFrame::on_patch(const Vec3& own) const {
  constexpr int steps = 8;
  const auto& c = corners_;
  const Vec3 along = c[1] - c[0], up = c[3] - c[0], twist = c[0] - c[1] + c[2] - c[3];
  Vector2d at(0.5, 0.5);
  for (int n = 0; n < steps; ++n) {
    Eigen::Matrix<double, 3, 2> slopes;
    slopes << along + at.y() * twist, up + at.x() * twist;
    const Vec3 away = own - (c[0] + at.x() * along + at.y() * up + at.x() * at.y() * twist);
    const Eigen::Matrix2d normal = slopes.transpose() * slopes;
    const double determinant = normal(0, 0) * normal(1, 1) - normal(0, 1) * normal(1, 0);
    if (!(determinant > 0)) break;
    const Vector2d right = slopes.transpose() * away;
    const Vector2d step((normal(1, 1) * right.x() - normal(0, 1) * right.y()) / determinant,
                        (normal(0, 0) * right.y() - normal(1, 0) * right.x()) / determinant);
    at += step;
    at = at.cwiseMax(-1).cwiseMin(2); // never far from the sheet
    if (twist.isZero(0)) break;
  }
  return at;
}

// sheet.cpp has the points of bands.
Vector2d PictureFrame::on_band(const Vec3& own, const Chart& chart) const {
  const auto [around, across] = *sheet_->size;
  const double radius = around / (2 * pi);
  double degrees = arc_tangent(own.x(), -own.z()) * 180 / pi;
  // within half a turn of the face's middle
  degrees += 360 * std::floor((chart.turn - degrees) / 360 + 0.5);
  const double s = degrees / 360;
  if (sheet_->closure == SheetClosure::Loop) return {s, own.y() / across + 0.5};
  const double outwards = std::sqrt(own.x() * own.x() + own.z() * own.z()) - radius;
  return {s, (cosine_of_degrees(180 * s) * own.y() + sine_of_degrees(180 * s) * outwards) / across + 0.5};
}

} // namespace rend
