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

std::string obstacles_in_words(const Scene& scene) {
  std::string out;
  const auto add = [&](const char* kind, std::size_t number, const Vec3& at) {
    out += fmt::format("{}{} {} at ({:.4g}, {:.4g}, {:.4g}) m", out.empty() ? "" : ", ", kind, number, at.x(),
                       at.y(), at.z());
  };
  const World& world = scene.world();
  for (std::size_t n = 0; n < world.spheres.size(); ++n) add("sphere", n + 1, world.spheres[n].centre);
  for (std::size_t n = 0; n < world.boxes.size(); ++n)
    add("box", n + 1, world.boxes[n].pose(scene.time()).of(world.boxes[n].middle()));
  return out;
}

} // namespace rend
