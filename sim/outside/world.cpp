#include "sim/outside/world.h"

#include "sim/base/reach.h"

namespace rend {

template <> const Fields<Floor>& fields_of() {
  using S = Floor;
  static const Fields<S> fields{field(&S::z, within(number("z", "m", "its height"), farthest)),
                                field(&S::friction, friction_attribute())};
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
