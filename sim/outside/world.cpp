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
  const bool round = number <= spheres.size();
  const std::size_t n = round ? number : number - spheres.size();
  const std::string& name = round ? spheres[n - 1].name : boxes[n - 1].name;
  return fmt::format("{} {}", round ? "sphere" : "box", name.empty() ? std::to_string(n) : in_quotes(name));
}

void check_world(const World& world) {
  check_settings(world);
  if (world.floor) check_settings(*world.floor);
  if (world.wind) check_settings(*world.wind);
  for (const Box& box : world.boxes) {
    check_settings(box);
    check_box(box);
  }
}

} // namespace rend
