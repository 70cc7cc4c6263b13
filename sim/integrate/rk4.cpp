// The classical Runge–Kutta scheme, thesis 2.39, for x'' = a(x, x'):
//
//   a1 = a(x, v)                               v1 = v
//   a2 = a(x + dt/2 v1, v + dt/2 a1)           v2 = v + dt/2 a1
//   a3 = a(x + dt/2 v2, v + dt/2 a2)           v3 = v + dt/2 a2
//   a4 = a(x + dt v3,   v + dt a3)             v4 = v + dt a3
//   x' = x + dt/6 (v1 + 2v2 + 2v3 + v4),       v' = v + dt/6 (a1 + 2a2 + 2a3 + a4)
//
// Order 4, stable up to 2√2/ω without damping (2.62/ω at ξ = 0.5, 2.78/2d where damping rules).
#include "sim/integrate/integrator.h"

#include <cmath>
#include <limits>

namespace rend {
namespace {

class RungeKutta4 final : public Integrator {
  State stage_;
  std::vector<Record> force_;                 // [N], of the stage
  std::vector<Record> velocities_, accelerations_; // weighted sums of those of the stages

  // Adds the derivative at a stage (its force f, its velocity v), with its weight, and goes on to the next stage, at
  // `ahead` from the start.
  void collect(const System& system, std::size_t i, Double4 f, Double4 v, double weight, const StateView& now,
               double ahead) {
    const Double4 a = system.acceleration(i, f, v);
    store(velocities_[i], load(velocities_[i]) + weight * v);
    store(accelerations_[i], load(accelerations_[i]) + weight * a);
    store(stage_.position[i], load(now.position[i]) + ahead * v);
    store(stage_.velocity[i], load(now.velocity[i]) + ahead * a);
  }

  void advance(System& system, double time, double step, const StateView& now, const Record* force,
               State& next) override {
    const std::size_t count = system.vertices();
    force_.resize(count);
    stage_.resize(count);
    velocities_.assign(count, {});
    accelerations_.assign(count, {});
    for (std::size_t i = 0; i < count; ++i)
      collect(system, i, load(force[i]), load(now.velocity[i]), 1, now, 0.5 * step);
    for (int stage = 2; stage <= 3; ++stage) {
      evaluate(system, time + 0.5 * step);
      const double ahead = stage == 2 ? 0.5 * step : step;
      for (std::size_t i = 0; i < count; ++i)
        collect(system, i, load(force_[i]), load(stage_.velocity[i]), 2, now, ahead);
    }
    evaluate(system, time + step);
    for (std::size_t i = 0; i < count; ++i) {
      const Double4 v = load(stage_.velocity[i]), a = system.acceleration(i, load(force_[i]), v);
      next.put(i, load(now.position[i]) + (step / 6) * (load(velocities_[i]) + v),
               load(now.velocity[i]) + (step / 6) * (load(accelerations_[i]) + a));
    }
    system.constrain(time + step, next.position.data(), next.velocity.data());
  }

  void evaluate(System& system, double time) {
    system.constrain(time, stage_.position.data(), stage_.velocity.data());
    system.forces(time, stage_.position.data(), stage_.velocity.data(), force_.data());
  }
};

double limit(const StabilityBounds& b) {
  const double d = b.damping_rate / 2;
  const double speed = std::sqrt(b.omega_squared + d * d) + d;
  return speed > 0 ? 2.6 / speed : std::numeric_limits<double>::infinity();
}

} // namespace

Scheme runge_kutta_4() {
  return {"rk4", "the classical Runge-Kutta scheme", 4, 4, &limit,
          []() -> std::unique_ptr<Integrator> { return std::make_unique<RungeKutta4>(); }};
}

} // namespace rend
