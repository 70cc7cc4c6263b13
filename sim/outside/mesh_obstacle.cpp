#include "sim/outside/mesh_obstacle.h"

#include "sim/base/bytes.h"
#include "sim/base/reach.h"
#include "sim/outside/obstacle.h"

#include <fmt/format.h>

namespace rend {

template <> const Fields<MeshObstacleSettings>& fields_of() {
  using S = MeshObstacleSettings;
  static const Fields<S> fields =
      Fields<S>{
          field(&S::file, text("file", "a mesh, as of <mesh>: a surface, or a solid whose surface counts; "
                                       "relative to the preset, and in its folder or below")
                              .is_required())} +
      fields_of_part(&S::motion) +
      Fields<S>{field(&S::friction, friction_attribute()), field(&S::restitution, restitution_attribute()),
                field(&S::name, obstacle_name_attribute())};
  return fields;
}

MeshObstacle::MeshObstacle(const MeshObstacleSettings& settings, ObstacleSurface of)
    : MeshObstacleSettings(settings), surface(std::move(of)) {
  check_motion(motion, source);
  if (surface.triangles.empty())
    source.fail("file", "the obstacle has no faces", "a mesh of polygons, or a solid");
  for (const auto& triangle : surface.triangles)
    for (const std::uint32_t corner : triangle)
      if (corner >= surface.points.size())
        source.fail("file", fmt::format("a triangle has a corner {}, and there are {} points", corner,
                                        surface.points.size()));
  for (const Vec3& x : surface.points) {
    bounds.extend(x);
    if (!(x.cwiseAbs().maxCoeff() <= farthest))
      source.fail("file",
                  fmt::format("a vertex lies {:g} m from the origin; at most {:g} m are allowed",
                              x.cwiseAbs().maxCoeff(), farthest),
                  "scale and translate of its <place> are in metres");
  }
}

double MeshObstacle::volume() const {
  double sum = 0;
  for (const auto& [a, b, c] : surface.triangles)
    sum +=
        (surface.points[a] - middle()).dot((surface.points[b] - middle()).cross(surface.points[c] - middle()));
  return sum / 6;
}

std::size_t MeshObstacle::bytes() const {
  return bytes_of(surface.points) + bytes_of(surface.triangles);
}

} // namespace rend
