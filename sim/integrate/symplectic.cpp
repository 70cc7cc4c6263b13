// Symplectic (semi-implicit) Euler, thesis 2.40: the velocity first, then the position with the new velocity.
//
//   v' = v + dt a(x, v),   x' = x + dt v'
//
// Order 1, stable up to 2/ω, and without damping its energy oscillates but does not drift.
#include "sim/integrate/integrator.h"

namespace rend {
namespace {

REND_INLINE void move(const System& system, std::size_t count, double step, const StateView& now,
                      const Record* force, State& next) {
  const Double4 h = splat(step);
  for (std::size_t i = 0; i < count; ++i) {
    const Double4 v = load(now.velocity[i]);
    const Double4 w = v + h * system.acceleration(i, load(force[i]), v);
    next.put(i, load(now.position[i]) + h * w, w);
  }
}

class SymplecticEuler final : public Integrator {
  void advance(System& system, double time, double step, const StateView& now, const Record* force,
               State& next) override {
    at_width<move>(system, system.vertices(), step, now, force, next);
    system.constrain(time + step, next.position.data(), next.velocity.data());
  }
};

} // namespace

Scheme symplectic_euler() {
  return {
      "symplectic",
      "symplectic Euler: velocity first, then position",
      1,
      1,
      &limit_symplectic,
      [](const SchemeSettings&) -> std::unique_ptr<Integrator> { return std::make_unique<SymplecticEuler>(); }};
}

} // namespace rend
