// Midpoint (RK2), thesis 2.38: the derivative at the middle of the step, reached by half an explicit step.
//
// Order 2. Without damping it gains energy, though slowly (z⁴/4 of the amplitude squared a step, z = ω dt).
#include "sim/integrate/integrator.h"

namespace rend {
namespace {

class Midpoint final : public Integrator {
  State middle_;
  std::vector<Record> force_; // [N], in the middle

  void advance(System& system, double time, double step, const StateView& now, const Record* force,
               State& next) override {
    const std::size_t count = system.vertices();
    force_.resize(count);
    middle_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const Double4 v = load(now.velocity[i]);
      store(middle_.position[i], load(now.position[i]) + (0.5 * step) * v);
      store(middle_.velocity[i], v + (0.5 * step) * system.acceleration(i, load(force[i]), v));
    }
    system.constrain(time + 0.5 * step, middle_.position.data(), middle_.velocity.data());
    system.forces(time + 0.5 * step, middle_.position.data(), middle_.velocity.data(), force_.data());
    for (std::size_t i = 0; i < count; ++i) {
      const Double4 v = load(middle_.velocity[i]);
      next.put(i, load(now.position[i]) + step * v,
               load(now.velocity[i]) + step * system.acceleration(i, load(force_[i]), v));
    }
    system.constrain(time + step, next.position.data(), next.velocity.data());
  }
};

} // namespace

Scheme midpoint() {
  return {"midpoint", "midpoint rule (RK2)", 2, 2, &limit_by_drag,
          []() -> std::unique_ptr<Integrator> { return std::make_unique<Midpoint>(); }};
}

} // namespace rend
