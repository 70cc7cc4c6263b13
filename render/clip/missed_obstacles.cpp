#include "render/clip/missed_obstacles.h"

#include <fmt/format.h>

namespace rend {

std::optional<bool> touched_nothing(const Scene& scene) {
  if (!scene.world().has_obstacles()) return {};
  bool collides = false, touched = false;
  for (const auto& body : scene.bodies()) {
    if (!body->contact || !body->contact->obstacles) continue;
    if (!body->work_meter) return {};
    collides = true;
    touched = touched || body->work_meter->work().contact.touched;
  }
  return collides ? std::optional(!touched) : std::nullopt;
}

std::vector<ObstacleFigures> obstacles_of(const Scene& scene) {
  const World& world = scene.world();
  std::vector<ObstacleFigures> all;
  const auto add = [&](std::size_t obstacle, const char* kind, std::size_t number, const std::string& name) {
    bool collides = false, touched = false;
    for (const auto& body : scene.bodies()) {
      const bool meets =
          obstacle == 0 ? body->floor_contact.has_value() : body->contact && body->contact->obstacles;
      if (!meets || !body->work_meter || body->contact_table.excludes_obstacle(obstacle)) continue;
      collides = true;
      touched = touched || body->work_meter->touched(obstacle);
    }
    if (collides) all.push_back({obstacle, kind, number, name, touched});
  };
  if (world.floor) add(0, "floor", 1, world.floor->name);
  for (std::size_t s = 0; s < world.spheres.size(); ++s)
    add(world.number_of_sphere(s), "sphere", s + 1, world.spheres[s].name);
  for (std::size_t b = 0; b < world.boxes.size(); ++b)
    add(world.number_of_box(b), "box", b + 1, world.boxes[b].name);
  for (std::size_t m = 0; m < world.meshes.size(); ++m)
    add(world.number_of_mesh(m), "obstacle", m + 1, world.meshes[m].name);
  return all;
}

std::string untouched_in_words(const Scene& scene) {
  const World& world = scene.world();
  std::string out;
  for (const ObstacleFigures& one : obstacles_of(scene)) {
    if (one.touched || one.kind == "floor") continue;
    const std::size_t n = one.number - 1;
    const auto middle = [&](const auto& obstacle) -> Vec3 {
      return obstacle.pose(scene.time()).of(obstacle.middle());
    };
    const Vec3 at = one.kind == "sphere" ? world.spheres[n].centre
                    : one.kind == "box"  ? middle(world.boxes[n])
                                         : middle(world.meshes[n]);
    out += fmt::format("{}{} at ({:.4g}, {:.4g}, {:.4g}) m", out.empty() ? "" : ", ",
                       world.called(one.obstacle), at.x(), at.y(), at.z());
  }
  return out;
}

} // namespace rend
