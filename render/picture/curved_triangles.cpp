#include "render/picture/curved_triangles.h"

#include "sim/base/check.h"

#include <Eigen/Geometry>

namespace rend {
namespace {

using Vec3d = Eigen::Vector3d;          // so that a side is rounded alike in both of its triangles
using PartWeights = std::array<int, 3>; // of the corners, in parts of a side
using CornerShare = std::array<double, 3>;

Vec3d vec(const std::array<float, 3>& x) {
  return {static_cast<double>(x[0]), static_cast<double>(x[1]), static_cast<double>(x[2])};
}

// Of a triangle whose corners are 0, 1, 2.
class CurvedPatch {
public:
  explicit CurvedPatch(const Corner* corners) : corners_(corners) {
    for (std::size_t k = 0; k < 3; ++k) at_[k] = vec(corners[k].position);
    Vec3d sides = Vec3d::Zero();
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b)
        if (a != b) sides += near_[a][b] = control(a, b);
    const Vec3d mean = sides / 6;
    middle_ = mean + (mean - (at_[0] + at_[1] + at_[2]) / 3) / 2;
  }

  Vec3d position(const CornerShare& w) const {
    Vec3d sum = 6 * w[0] * w[1] * w[2] * middle_;
    for (std::size_t a = 0; a < 3; ++a) {
      sum += w[a] * w[a] * w[a] * at_[a];
      for (std::size_t b = 0; b < 3; ++b)
        if (a != b) sum += 3 * w[a] * w[a] * w[b] * near_[a][b];
    }
    return sum;
  }

private:
  // The control point on side ab that is nearer to a.
  Vec3d control(std::size_t a, std::size_t b) const {
    const Vec3d straight = (2 * at_[a] + at_[b]) / 3, normal = vec(corners_[a].normal);
    const auto line = static_cast<Line>(corners_[a].line[3 - a - b]);
    const bool curved = line == Line::None || line == Line::Cell || line == Line::Border;
    return curved ? Vec3d(straight - (at_[b] - at_[a]).dot(normal) / 3 * normal) : straight;
  }

  const Corner* corners_;
  std::array<Vec3d, 3> at_;
  std::array<std::array<Vec3d, 3>, 3> near_;
  Vec3d middle_;
};

// One small triangle after the other, as weights of its corners.
template <class F> void each_part(int parts, F&& f) {
  const auto at = [&](int i, int j) { return PartWeights{parts - i - j, i, j}; };
  for (int i = 0; i < parts; ++i)
    for (int j = 0; i + j < parts; ++j) {
      f(std::array{at(i, j), at(i + 1, j), at(i, j + 1)});
      if (i + j + 1 < parts) f(std::array{at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
}

// The line along the side between two points: that of the side of the triangle on which both lie.
std::uint8_t line_between(const Corner* corners, const PartWeights& a, const PartWeights& b) {
  for (std::size_t k = 0; k < 3; ++k)
    if (a[k] == 0 && b[k] == 0) return corners->line[k];
  return static_cast<std::uint8_t>(Line::None);
}

template <std::size_t N, class Get> std::array<float, N> mean(const CornerShare& share, Get&& of) {
  std::array<float, N> sum{};
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t c = 0; c < N; ++c) sum[c] += static_cast<float>(share[k]) * static_cast<float>(of(k)[c]);
  return sum;
}

Corner corner_at(const Corner* corners, const CurvedPatch& patch, const CornerShare& share) {
  Corner corner = corners[0];
  const Vec3d x = patch.position(share);
  corner.position = as_floats(x);
  const Vec3d normal = vec(mean<3>(share, [&](std::size_t k) { return corners[k].normal; }));
  corner.normal = as_floats(normal.normalized());
  const auto colour = mean<4>(share, [&](std::size_t k) { return corners[k].colour; });
  for (std::size_t c = 0; c < 4; ++c) corner.colour[c] = static_cast<std::uint8_t>(colour[c] + 0.5f);
  return corner;
}

} // namespace

void curve_triangles(FrameBody& body, int parts) {
  CHECK(parts >= 1);
  if (parts == 1) return;
  const std::size_t more = static_cast<std::size_t>(parts) * static_cast<std::size_t>(parts);
  std::vector<Corner> corners;
  std::vector<TexturePoint> points;
  corners.reserve(body.corners.size() * more);
  points.reserve(body.texture_points.size() * more);
  for (std::size_t first = 0; first + 2 < body.corners.size(); first += 3) {
    const Corner* of = &body.corners[first];
    const CurvedPatch patch(of);
    each_part(parts, [&](const std::array<PartWeights, 3>& part) {
      const std::array<std::uint8_t, 4> lines{line_between(of, part[1], part[2]),
                                              line_between(of, part[2], part[0]),
                                              line_between(of, part[0], part[1]), 0};
      for (const PartWeights& weights : part) {
        CornerShare share{};
        for (std::size_t k = 0; k < 3; ++k) share[k] = static_cast<double>(weights[k]) / parts;
        corners.push_back(corner_at(of, patch, share));
        corners.back().line = lines;
        if (!body.texture_points.empty())
          points.push_back(mean<2>(share, [&](std::size_t k) { return body.texture_points[first + k]; }));
      }
    });
  }
  body.corners = std::move(corners);
  body.texture_points = std::move(points);
}

} // namespace rend
