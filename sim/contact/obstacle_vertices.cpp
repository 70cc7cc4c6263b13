#include "sim/contact/obstacle_vertices.h"

#include "sim/base/bytes.h"

namespace rend {

ObstacleVertices::ObstacleVertices(const MeshObstacle& mesh, std::size_t number_, double thickness)
    : number(number_), name(mesh.name), mesh_(mesh) {
  settings.floor = settings.obstacles = settings.fragments = settings.self = false;
  settings.thickness = thickness;
  for (const Vec3& x : mesh.surface.points) from.emplace_back(x);
  position = from;
  velocity.resize(from.size());
  if (closed()) inside_.emplace(mesh);
}

void ObstacleVertices::move(double time, double step) {
  if (fixed()) return;
  way_ = {mesh_.pose(time - step), mesh_.pose(time), step};
  for (std::size_t v = 0; v < from.size(); ++v) {
    const Vec3 x = way_.from.of(start(v)), next = way_.to.of(start(v));
    from[v] = Record(x);
    position[v] = Record(next);
    velocity[v] = Record((next - x) / step);
  }
}

bool ObstacleVertices::lies_behind(const Vec3& x, double depth) const {
  constexpr double rounding = 1e-9;
  const double least = rounding * mesh_.bounds.diagonal().norm();
  if (!inside_ || depth <= least) return true;
  const Vec3 X = way_.from.back(x);
  return inside_->tree.inside(X) && depth <= (1 + rounding) * inside_->tree.nearest(X).distance + least;
}

std::size_t ObstacleVertices::bytes() const {
  return bytes_of(from) + bytes_of(position) + bytes_of(velocity) + (inside_ ? inside_->tree.bytes() : 0);
}

} // namespace rend
