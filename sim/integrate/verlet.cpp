// Velocity Verlet:   x' = x + dt v + dt²/2 a,   v' = v + dt/2 (a(x, v) + a(x', v + dt a))
//
// Order 2; damping is evaluated at the predicted velocity, which preserves the order. Stable up to 2/ω without
// damping.
#include "sim/integrate/integrator.h"
#include "sim/integrate/leapfrog.h"
#include "sim/integrate/vertex_loop.h"

namespace rend {
namespace {

REND_INLINE void predict(std::size_t begin, std::size_t end, const System& system, double step,
                         const StateView& now, const Record* force, State& next) {
  const Double4 h = splat(step), half_square = splat(0.5 * step * step);
  for (std::size_t i = begin; i < end; ++i) {
    const Double4 v = load(now.velocity[i]), a = system.acceleration(i, load(force[i]), v);
    store(next.position[i], load(now.position[i]) + h * v + half_square * a);
    store(next.velocity[i], v + h * a);
  }
}

// With the predicted w = v + dt a, v + dt/2 a is (v + w)/2: the loads of the start are no longer available.
REND_INLINE void correct(std::size_t begin, std::size_t end, const System& system, double step,
                         const StateView& now, const Record* force_there, State& next, Double4& probe) {
  Double4 seen = probe;
  const Double4 half = splat(0.5), half_step = splat(0.5 * step);
  for (std::size_t i = begin; i < end; ++i) {
    const Double4 w = load(next.velocity[i]);
    const Double4 b = system.acceleration(i, load(force_there[i]), w);
    next.write(i, load(next.position[i]), half * (load(now.velocity[i]) + w) + half_step * b, seen);
  }
  probe = seen;
}

class VelocityVerlet final : public Integrator {
  std::vector<Record> force_; // [N], at the new positions

  std::size_t bytes() const override { return bytes_of(force_); }

  void advance(System& system, double time, double step, const StateView& now, const Record* force,
               State& next) override {
    const std::size_t count = system.vertices();
    force_.resize(count);
    over_vertices<predict>(system, step, now, force, next);
    system.constrain(time + step, next.position.data(), next.velocity.data());
    system.forces(time + step, next.position.data(), next.velocity.data(), force_.data());
    write_vertices<correct>(system, next, step, now, force_.data());
    system.constrain(time + step, next.position.data(), next.velocity.data());
  }
};

} // namespace

Scheme velocity_verlet() {
  return {.name = "verlet",
          .what = "velocity Verlet, damping at the predicted velocity",
          .order = 2,
          .evaluations = 2,
          .limit = &limit_symplectic,
          .make = &make_integrator<VelocityVerlet>,
          .force_shadow = leapfrog_shadow,
          .contact = ContactIn::Step};
}

} // namespace rend
