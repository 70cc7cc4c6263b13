#include "render/draw/packing.h"

#include "sim/base/check.h"

#include <utility>

namespace rend {
namespace {

using Eigen::Vector3f;
using ConstMap = Eigen::Map<const Vector3f>;

// Prepares the three corners of a triangle; wound: their order defines the front.
void orient(Corner* corner, bool keeps_order) {
  const ConstMap a(corner[0].position.data()), b(corner[1].position.data()), c(corner[2].position.data());
  const Vector3f across = (b - a).cross(c - a); // twice the area times the normal, counter-clockwise
  // The sum is finite if each number is; it could overflow only for coordinates that no frame has.
  Vector3f sum = a + b + c, normals = Vector3f::Zero();
  for (int k = 0; k < 3; ++k) normals += ConstMap(corner[k].normal.data());
  CHECK_NOTE((sum + normals).allFinite(), "a frame holds a number that is not finite");

  const bool flat = normals.isZero(0.0f);
  if (flat) {
    const float length = across.norm();
    if (!(length > 0)) return;
    for (int k = 0; k < 3; ++k) Eigen::Map<Vector3f>(corner[k].normal.data()) = across / length;
  } else if (!keeps_order && normals.dot(across) < 0) {
    std::swap(corner[1], corner[2]);
    for (int k = 0; k < 3; ++k) std::swap(corner[k].line[1], corner[k].line[2]);
  }
}

} // namespace

Eigen::AlignedBox3d bounds_of(const FrameBody& body) {
  Eigen::AlignedBox3f bounds;
  for (const Corner& corner : body.corners) bounds.extend(ConstMap(corner.position.data()));
  return bounds.isEmpty() ? Eigen::AlignedBox3d() : bounds.cast<double>();
}

void pack(const FrameBody& body, std::vector<Corner>& packed) {
  CHECK(body.corners.size() % 3 == 0);
  const std::size_t first = packed.size();
  packed.insert(packed.end(), body.corners.begin(), body.corners.end());
  for (std::size_t i = first; i < packed.size(); i += 3) orient(&packed[i], !body.two_sided);
}

} // namespace rend
