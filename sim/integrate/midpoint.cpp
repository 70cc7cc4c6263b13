// Midpoint (RK2), thesis 2.38: the derivative at the middle of the step, reached by half an explicit step.
//
// Order 2. Without damping it gains energy, though slowly (z⁴/4 of the squared amplitude per step, z = ω dt).
// With d = ξω it is stable if dt d ≤ 1 and (ω dt)² ≤ 2a + 2√(a(2−a)), a = dt d: for little damping up to 2
// ξ^⅓/ω.
#include "sim/integrate/integrator.h"
#include "sim/integrate/vertex_loop.h"

#include <cmath>

namespace rend {
namespace {

REND_INLINE void halfway(std::size_t begin, std::size_t end, const System& system, double step,
                         const StateView& now, const Record* force, State& middle) {
  const Double4 half = splat(0.5 * step);
  for (std::size_t i = begin; i < end; ++i) {
    const Double4 v = load(now.velocity[i]);
    store(middle.position[i], load(now.position[i]) + half * v);
    store(middle.velocity[i], v + half * system.acceleration(i, load(force[i]), v));
  }
}

REND_INLINE void across(std::size_t begin, std::size_t end, const System& system, double step,
                        const StateView& now, const Record* force, const State& middle, State& next,
                        Double4& probe) {
  Double4 seen = probe;
  const Double4 h = splat(step);
  for (std::size_t i = begin; i < end; ++i) {
    const Double4 v = load(middle.velocity[i]);
    next.write(i, load(now.position[i]) + h * v,
               load(now.velocity[i]) + h * system.acceleration(i, load(force[i]), v), seen);
  }
  probe = seen;
}

class Midpoint final : public Integrator {
  State middle_;
  std::vector<Record> force_; // [N], in the middle

  std::size_t bytes() const override { return middle_.bytes() + bytes_of(force_); }

  void advance(System& system, double time, double step, const StateView& now, const Record* force,
               State& next) override {
    const std::size_t count = system.vertices();
    force_.resize(count);
    middle_.resize(count);
    over_vertices<halfway>(system, step, now, force, middle_);
    system.constrain(time + 0.5 * step, middle_.position.data(), middle_.velocity.data());
    system.forces(time + 0.5 * step, middle_.position.data(), middle_.velocity.data(), force_.data());
    write_vertices<across>(system, next, step, now, force_.data(), middle_);
    system.constrain(time + step, next.position.data(), next.velocity.data());
  }
};

// The right-hand side increases with d up to dt d = 1, so that the smallest d is decisive, and the largest ends
// the search.
double limit_midpoint(const StabilityBounds& b) {
  if (b.omega_squared == 0 || b.least_drag_rate <= 0) return limit_by_drag(b);
  double low = 0, high = 2 / b.damping_rate;
  for (int n = 0; n < 60; ++n) {
    const double h = 0.5 * (low + high), a = 0.5 * h * b.least_drag_rate;
    (h * h * b.omega_squared <= 2 * a + 2 * std::sqrt(a * (2 - a)) ? low : high) = h;
  }
  return low;
}

} // namespace

Scheme midpoint() {
  return {.name = "midpoint",
          .what = "midpoint rule (RK2)",
          .order = 2,
          .evaluations = 2,
          .limit = &limit_midpoint,
          .make = &make_integrator<Midpoint>};
}

} // namespace rend
