// The vertices of a mesh obstacle in a step of contact: prescribed, so of infinite mass.
//
// A vertex goes from x = X(t) to x' = X(t + h) along a straight line, with the velocity (x' − x)/h of
// RigidStep: what lies on the obstacle is carried on average over the step. One that never moves is placed
// once, and never measured again.
#pragma once

#include "sim/contact/standing_mesh.h"
#include "sim/outside/contact_settings.h"

#include <optional>

namespace rend {

class ObstacleVertices {
public:
  // `number_`: of the obstacle in the world; `thickness` [m]: as that of a body.
  ObstacleVertices(const MeshObstacle& mesh, std::size_t number_, double thickness);

  void move(double time, double step); // [s]: to the end of a step, and its size
  bool fixed() const { return !mesh_.moves(); }
  bool closed() const { return mesh_.surface.closed; }
  // [m], where a point is at the end of the step that is at x [m] at its start.
  Vec3 carried(const Vec3& x) const { return way_.to.of(way_.from.back(x)); }
  // Whether a point at x [m] at the start of the step, which lies `depth` [m] behind the plane of one of its
  // faces, is in it, and leaves it by no nearer face. A face may be much larger than the obstacle is thick
  // there.
  bool lies_behind(const Vec3& x, double depth) const;
  // [m], a point as the preset puts it.
  const Vec3& start(std::size_t v) const { return mesh_.surface.points[v]; }
  std::size_t bytes() const;

  std::size_t number;       // of the obstacle in the world
  std::string name;         // as users call it
  ContactSettings settings; // with nothing by itself
  // One per vertex: [m] at the start and the end of the step, [m/s].
  std::vector<Record> from, position, velocity;

private:
  const MeshObstacle& mesh_;
  RigidStep way_;
  std::optional<StandingMesh> inside_; // none: it is open
};

} // namespace rend
