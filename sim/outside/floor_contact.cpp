#include "sim/outside/floor_contact.h"

#include "sim/outside/impact.h"

namespace rend {

void FloorContact::apply(State& next, double step) const {
  for (std::size_t i = 0; i < next.position.size(); ++i) {
    Record &x = next.position[i], &v = next.velocity[i];
    if (!(x.z < height)) continue;
    const Impulse change = impact(v, Vec3::UnitZ(), friction, Vec3::Ones());
    x = Record(x.x + step * change.friction.x(), x.y + step * change.friction.y(), height);
    v = Record(v.vec() + change.whole());
  }
}

} // namespace rend
