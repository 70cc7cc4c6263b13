#include "render/draw/packing.h"

#include "sim/base/check.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rend {
namespace {

using Eigen::Vector3f;
using ConstMap = Eigen::Map<const Vector3f>;

bool is_too_far(std::span<const Corner, 3> triangle) {
  return std::any_of(triangle.begin(), triangle.end(), [](const Corner& corner) {
    const ConstMap x(corner.position.data());
    return x.allFinite() && x.cwiseAbs().maxCoeff() > farthest_drawn;
  });
}

// Prepares the three corners of a triangle. True: the last two changed places.
bool orient(Corner* corner, bool keeps_order) {
  const ConstMap a(corner[0].position.data()), b(corner[1].position.data()), c(corner[2].position.data());
  const Vector3f across = (b - a).cross(c - a); // twice the area times the normal, counter-clockwise
  // The sum is finite if each number is: what is too far has been left out.
  Vector3f sum = a + b + c, normals = Vector3f::Zero();
  for (int k = 0; k < 3; ++k) normals += ConstMap(corner[k].normal.data());
  CHECK_NOTE((sum + normals).allFinite(), "a frame holds a number that is not finite");

  const bool flat = normals.isZero(0.0f);
  if (flat) {
    const float length = across.norm();
    if (!(length > 0)) return false;
    for (int k = 0; k < 3; ++k) Eigen::Map<Vector3f>(corner[k].normal.data()) = across / length;
  } else if (!keeps_order && normals.dot(across) < 0) {
    std::swap(corner[1], corner[2]);
    for (int k = 0; k < 3; ++k) std::swap(corner[k].line[1], corner[k].line[2]);
    return true;
  }
  return false;
}

bool is_finite(const TexturePoint& point) {
  return std::isfinite(point[0]) && std::isfinite(point[1]);
}

} // namespace

Eigen::AlignedBox3d bounds_of(std::span<const Corner> corners) {
  Eigen::AlignedBox3f bounds;
  for (const Corner& corner : corners) bounds.extend(ConstMap(corner.position.data()));
  return bounds.isEmpty() ? Eigen::AlignedBox3d() : bounds.cast<double>();
}

void pack(const FrameBody& body, std::vector<Corner>& packed, std::vector<TexturePoint>& points) {
  const bool textured = body.texture.any();
  CHECK(body.corners.size() % 3 == 0);
  CHECK(body.texture_points.size() == (textured ? body.corners.size() : 0));
  packed.reserve(packed.size() + body.corners.size());
  for (std::size_t i = 0; i < body.corners.size(); i += 3) {
    const std::span<const Corner, 3> triangle(&body.corners[i], 3);
    if (is_too_far(triangle)) continue;
    packed.insert(packed.end(), triangle.begin(), triangle.end());
    const bool turned = orient(&packed[packed.size() - 3], !body.two_sided);
    for (const std::size_t k : {std::size_t{0}, std::size_t{turned ? 2U : 1U}, std::size_t{turned ? 1U : 2U}}) {
      if (!textured) break;
      points.push_back(body.texture_points[i + k]);
      CHECK_NOTE(is_finite(points.back()), "a place in a picture is not finite");
    }
  }
}

} // namespace rend
