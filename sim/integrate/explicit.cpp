// Explicit Euler, thesis 2.36:   v' = v + dt a(x, v),   x' = x + dt v
//
// Order 1. Without damping it gains energy at any step; with it, stable up to 2ξ/ω.
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
    next.write(i, load(now.position[i]) + h * v, v + h * system.acceleration(i, load(force[i]), v), seen);
  }
  probe = seen;
}

class ExplicitEuler final : public Integrator {
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

Scheme explicit_euler() {
  return {
      "explicit",
      "explicit Euler: stable through damping alone",
      1,
      1,
      &limit_by_drag,
      [](const SchemeSettings&) -> std::unique_ptr<Integrator> { return std::make_unique<ExplicitEuler>(); }};
}

} // namespace rend
