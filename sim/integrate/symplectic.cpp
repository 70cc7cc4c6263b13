// Symplectic (semi-implicit) Euler, thesis 2.40: the velocity first, then the position with the new velocity.
//
//   v' = v + dt a(x, v),   x' = x + dt v'
//
// Order 1, stable up to 2/ω, and without damping its energy oscillates but does not drift.
#include "sim/integrate/integrator.h"
#include "sim/integrate/vertex_loop.h"

namespace rend {
namespace {

REND_INLINE void move(std::size_t begin, std::size_t end, const System& system, double step,
                      const StateView& now, const Record* force, State& next, Double4& probe) {
  const Double4 h = splat(step);
  Double4 seen = probe;
  for (std::size_t i = begin; i < end; ++i) {
    expect<2048>(now.velocity + i);
    const Double4 v = load(now.velocity[i]);
    const Double4 w = v + h * system.acceleration(i, load(force[i]), v);
    next.write(i, load(now.position[i]) + h * w, w, seen);
  }
  probe = seen;
}

class SymplecticEuler final : public Integrator {
  void advance(System& system, double time, double step, const StateView& now, const Record* force,
               State& next) override {
    put_vertices<move>(system, next, step, now, force);
    system.constrain(time + step, next.position.data(), next.velocity.data());
  }
  void sweep(System& system, double time, double step, const StateView& now, Record* force,
             State& next) override {
    sweep_vertices<move>(system, time, next, step, now, force);
    system.constrain(time + step, next.position.data(), next.velocity.data());
  }
  bool sweeps() const override { return true; }
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
