// A mesh obstacle in a tree of its faces, as the preset puts it: for single points, which are taken back to
// there by its pose.
#pragma once

#include "sim/contact/surface_tree.h"

namespace rend {

struct StandingMesh {
  explicit StandingMesh(const MeshObstacle& mesh)
      : obstacle(&mesh),
        tree(ContactFaces(mesh.surface), records_of(mesh.surface.points), mesh.surface.closed) {}
  const MeshObstacle* obstacle;
  SurfaceTree tree;

private:
  static std::vector<Record> records_of(const std::vector<Vec3>& points) {
    return {points.begin(), points.end()};
  }
};

} // namespace rend
