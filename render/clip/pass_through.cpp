#include "render/clip/pass_through.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {
namespace {

constexpr double hair = 0.002; // relative to the diagonal of the body's bounding box

double size_at_rest(const Body& body) {
  Eigen::AlignedBox3d bounds;
  const CellIndex& cells = body.map->cells(Vertex);
  for (Slot v = 0; v < cells.slots(); ++v)
    if (cells.alive(v)) bounds.extend(Vec3(body.map->rest()[v].vec()));
  return bounds.isEmpty() ? 0 : bounds.diagonal().norm();
}

// A function of a point: how deep it lies inside [m]; not above 0: outside.
auto depth_in(const Sphere& sphere, double) {
  return [&sphere](const Vec3& x) { return sphere.radius - (x - sphere.centre).norm(); };
}
auto depth_in(const Box& box, double time) {
  return [&box, pose = box.pose(time)](const Vec3& there) {
    const Vec3 x = pose.back(there);
    return std::min((x - box.low).minCoeff(), (box.high - x).minCoeff());
  };
}

auto depth_in(const StandingMesh& mesh, double time) {
  return [&mesh, pose = mesh.obstacle->pose(time)](const Vec3& there) {
    const Vec3 x = pose.back(there);
    return mesh.tree.inside(x) ? mesh.tree.nearest(x).distance : 0;
  };
}

// Whether a vertex lies deeper than that; `depth`: of a point.
template <class F> bool has_vertex_deeper_than(double least, const Body& body, F&& depth) {
  const CellIndex& cells = body.map->cells(Vertex);
  for (Slot v = 0; v < cells.slots(); ++v)
    if (cells.alive(v) && depth(Vec3(body.map->position()[v].vec())) > least) return true;
  return false;
}

template <class Obstacle>
bool lies_in_one(double least, const Body& body, const std::vector<Obstacle>& obstacles, double time) {
  return std::any_of(obstacles.begin(), obstacles.end(), [&](const Obstacle& one) {
    return has_vertex_deeper_than(least, body, depth_in(one, time));
  });
}

} // namespace

PassThrough::PassThrough(const Scene& scene) : scene_(scene) {
  const World& world = scene.world();
  for (const auto& body : scene.bodies()) {
    const bool obstacles = !(body->contact && body->contact->obstacles);
    const Watched watched{body.get(),
                          hair * size_at_rest(*body),
                          world.floor && !body->floor_contact,
                          obstacles && !world.spheres.empty(),
                          obstacles && !world.boxes.empty(),
                          obstacles && !world.meshes.empty()};
    if (watched.floor || watched.spheres || watched.boxes || watched.meshes) bodies_.push_back(watched);
  }
  const bool any = std::ranges::any_of(bodies_, [](const Watched& one) { return one.meshes; });
  for (const MeshObstacle& mesh : world.meshes)
    if (any && mesh.surface.closed) meshes_.emplace_back(mesh);
}

void PassThrough::look(long frame) {
  const World& world = scene_.world();
  for (Watched& watched : bodies_) {
    const Body& body = *watched.body;
    if (watched.floor &&
        has_vertex_deeper_than(watched.hair, body, [&](const Vec3& x) { return world.floor->z - x.z(); })) {
      watched.floor = false;
      tell(body, frame, "the floor", "floor");
    }
    if (watched.spheres && lies_in_one(watched.hair, body, world.spheres, scene_.time())) {
      watched.spheres = false;
      tell(body, frame, "a sphere", "obstacles");
    }
    if (watched.boxes && lies_in_one(watched.hair, body, world.boxes, scene_.time())) {
      watched.boxes = false;
      tell(body, frame, "a box", "obstacles");
    }
    if (watched.meshes && lies_in_one(watched.hair, body, meshes_, scene_.time())) {
      watched.meshes = false;
      tell(body, frame, "an obstacle", "obstacles");
    }
  }
}

void PassThrough::tell(const Body& body, long frame, const char* what, const char* remedy) {
  notes_.push_back(
      body.contact ? fmt::format("'{}' passes through {} from frame {} on: add `{}` to its <contact with>",
                                 body.name, what, frame, remedy)
                   : fmt::format("'{}' passes through {} from frame {} on: add <contact with=\"{}\"/> to it",
                                 body.name, what, frame, remedy));
}

} // namespace rend
