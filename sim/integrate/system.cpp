#include "sim/integrate/system.h"

#include "sim/base/archive.h"
#include "sim/base/check.h"

namespace rend {

void State::probe_all() {
  probe = Double4{};
  for (std::size_t i = 0; i < position.size(); ++i) {
    const Double4 v = load(velocity[i]);
    probe += v * v + 0.0 * load(position[i]);
  }
}

void State::store(Archive& archive, std::size_t most) {
  archive.list(position, most, "a state is of more vertices than the body has");
  archive.list(velocity, most, "a state is of more vertices than the body has");
  if (accelerates) archive.list(acceleration, most, "a state is of more vertices than the body has");
  archive(large, staggered);
  archive.raw(&probe, sizeof probe);
  if (!archive.reading()) return;
  refuse_unless(position.size() == velocity.size(), "a state has not as many velocities as positions");
  refuse_unless(!accelerates || acceleration.size() == position.size(),
                "a state has not as many accelerations as positions");
  refuse_unless(finite(), "a number of a state is not finite");
}

std::shared_ptr<const BlockPattern> System::pattern() {
  CHECK_NOTE(false, "a system without stiffness was given to a scheme that solves");
}

void System::add_stiffness(const Record*, const Record*, Tangent, double, double, BlockMatrix&) {
  CHECK_NOTE(false, "a system without stiffness was given to a scheme that solves");
}

void System::forces_in_ranges(double time, const Record* position, const Record* velocity, Record* force,
                              RangeFunction whole) {
  forces(time, position, velocity, force);
  whole(0, vertices());
}

void System::update_loads(double, const Record*, const Record*) {}

void System::mark_prescribed(double, std::uint8_t*) {}

void System::begin_solve(double, double, const StateView&, const Record*) {}

bool System::tighten_contact(const Record*) {
  return false;
}

} // namespace rend
