#include "sim/contact/starting.h"

namespace rend {
namespace {

constexpr double not_inside = 1e-9; // relative to the size of the body: less deep is not inside

} // namespace

Starting::Starting(Body& body_, std::size_t number_)
    : body(&body_), number(number_), solid_(body_.map->dimension() == 3) {
  const CellIndex& cells = body->map->cells(Vertex);
  held.assign(cells.slots(), 0);
  body->constrain(0, body->map->position().values().data(), body->map->velocity().values().data());
  body->constraints.mark(0, held.data());
  for (Slot v = 0; v < cells.slots(); ++v) {
    if (!cells.alive(v)) continue;
    alive.push_back(v);
    bounds.extend(at(v));
    movable = movable && held[v] == 0;
  }
  if (settings().faces() && !alive.empty()) faces.emplace(*body->map, body->boundary());
  look();
}

Starting::Starting(const MeshObstacle& mesh, std::size_t number_)
    : number(number_), movable(false), solid_(mesh.surface.closed) {
  const Pose pose = mesh.pose(0);
  held.assign(mesh.surface.points.size(), everywhere);
  for (const Vec3& x : mesh.surface.points) {
    alive.push_back(static_cast<Slot>(placed_.size()));
    placed_.emplace_back(pose.of(x));
    bounds.extend(placed_.back().vec());
  }
  faces.emplace(mesh.surface);
  look();
}

double Starting::least() const {
  return not_inside * bounds.diagonal().norm();
}

void Starting::move(const Vec3& by) {
  for (Slot v : alive) {
    auto& position = body->map->position().values();
    auto& rest = body->map->rest().values();
    position[v] = Record(position[v].vec() + by);
    rest[v] = Record(rest[v].vec() + by);
  }
  bounds.translate(by);
  moved += by;
  look();
}

void Starting::look() {
  if (faces) tree.emplace(*faces, positions(), solid());
}

} // namespace rend
