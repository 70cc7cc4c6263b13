#include "sim/contact/sphere_on_mesh.h"

#include <algorithm>

namespace rend {
namespace {

constexpr double in_plane = 1e-6; // relative to the radius: what is less in front of a plane lies in it

// Towards the sphere: away from the nearest point of a face, or where that is the centre along its normal.
Vec3 direction(const SurfaceTree::Nearest& near, const Vec3& from, const Vec3& to) {
  if (near.distance > 0) return (to - near.point) / near.distance;
  return near.normal.dot(from - near.point) < 0 ? Vec3(-near.normal) : near.normal;
}

} // namespace

std::vector<Plane> planes_against(const SurfaceTree& mesh, double radius, const Vec3& from, const Vec3& to) {
  for (const SurfaceTree::Crossing& crossing : mesh.crossings(from, to)) {
    const Vec3 normal = mesh.normal(crossing.triangle), at = from + crossing.share * (to - from);
    if (crossing.share == 0 || normal.isZero(0)) continue; // its way leads out
    const Vec3 back = normal.dot(from - to) < 0 ? Vec3(-normal) : normal;
    return {Plane{back, back.dot(at) + radius}};
  }
  std::vector<Plane> planes;
  for (const SurfaceTree::Nearest& near : mesh.within(to, radius)) {
    const bool behind = std::ranges::any_of(planes, [&](const Plane& plane) {
      return plane.normal.dot(near.point) - (plane.offset - radius) <= in_plane * radius;
    });
    if (behind) continue;
    const Vec3 normal = direction(near, from, to);
    planes.push_back({normal, normal.dot(near.point) + radius});
  }
  return planes;
}

} // namespace rend
