#include "sim/integrate/system.h"

#include "sim/base/archive.h"
#include "sim/base/check.h"

namespace rend {

void State::look() {
  probe = Double4{};
  for (std::size_t i = 0; i < position.size(); ++i) {
    const Double4 v = load(velocity[i]);
    probe += v * v + 0.0 * load(position[i]);
  }
}

void State::store(Archive& archive) {
  archive(position, velocity, large);
  archive.raw(&probe, sizeof probe);
}

std::shared_ptr<const BlockPattern> System::pattern() {
  CHECK_NOTE(false, "a system without stiffness was given to a scheme that solves");
}

void System::add_stiffness(const Record*, const Record*, Tangent, double, double, BlockMatrix&) {
  CHECK_NOTE(false, "a system without stiffness was given to a scheme that solves");
}

void System::forces_in_stretches(double time, const Record* position, const Record* velocity, Record* force,
                                 PartWork whole) {
  forces(time, position, velocity, force);
  whole(0, vertices());
}

void System::outer(double, const Record*, const Record*) {}

void System::hold(double, std::uint8_t*) {}

} // namespace rend
