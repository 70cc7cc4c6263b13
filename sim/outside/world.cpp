#include "sim/outside/world.h"

#include "sim/base/reach.h"

#include <fmt/format.h>

namespace rend {

template <> const Fields<Floor>& fields_of() {
  using S = Floor;
  static const Fields<S> fields{
      field(&S::z, within(number("z", "m", "its height"), farthest)), field(&S::friction, friction_attribute()),
      field(&S::restitution, restitution_attribute()), field(&S::name, obstacle_name_attribute())};
  return fields;
}

template <> const Fields<World>& fields_of() {
  using S = World;
  static const Fields<S> fields{
      field(&S::gravity, within(numbers("gravity", 3, "m/s2", "its acceleration"), fastest)), // a second
      field(
          &S::over,
          number("over", "s", "gravity grows linearly from 0 to its full value during this time").at_least(0))};
  return fields;
}

std::string World::called(std::size_t number) const {
  if (number == 0) return floor && !floor->name.empty() ? "the floor " + in_quotes(floor->name) : "the floor";
  const auto words = [](const char* kind, const auto& of, std::size_t n) {
    return fmt::format("{} {}", kind, of[n].name.empty() ? std::to_string(n + 1) : in_quotes(of[n].name));
  };
  if (number >= number_of_mesh(0)) return words("obstacle", meshes, number - number_of_mesh(0));
  if (number >= number_of_box(0)) return words("box", boxes, number - number_of_box(0));
  return words("sphere", spheres, number - number_of_sphere(0));
}

void check_world(const World& world) {
  check_settings(world);
  if (world.floor) check_settings(*world.floor);
  if (world.wind) check_settings(*world.wind);
  for (const Box& box : world.boxes) {
    check_settings(box);
    check_box(box);
  }
  for (const MeshObstacle& mesh : world.meshes) check_settings<MeshObstacleSettings>(mesh);
}

} // namespace rend
