#include "sim/scene/contact.h"

#include <algorithm>
#include <cmath>

namespace rend {

void FloorContact::apply(State& next, double step) const {
  for (std::size_t i = 0; i < next.position.size(); ++i) {
    Record& x = next.position[i];
    if (!(x.z < height)) continue;
    Record& v = next.velocity[i];
    const double lost = std::max(0.0, -v.z), along = std::sqrt(v.x * v.x + v.y * v.y);
    const double kept = along > 0 ? std::max(0.0, 1 - friction * lost / along) : 0;
    x = Record(x.x - step * (1 - kept) * v.x, x.y - step * (1 - kept) * v.y, height);
    v = Record(kept * v.x, kept * v.y, std::max(0.0, v.z));
  }
}

} // namespace rend
