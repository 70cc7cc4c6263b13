// The classical Runge–Kutta scheme, thesis 2.39, for x'' = a(x, x'):
//
//   a1 = a(x, v)                               v1 = v
//   a2 = a(x + dt/2 v1, v + dt/2 a1)           v2 = v + dt/2 a1
//   a3 = a(x + dt/2 v2, v + dt/2 a2)           v3 = v + dt/2 a2
//   a4 = a(x + dt v3,   v + dt a3)             v4 = v + dt a3
//   x' = x + dt/6 (v1 + 2v2 + 2v3 + v4),       v' = v + dt/6 (a1 + 2a2 + 2a3 + a4)
//
// Order 4, stable up to 2√2/ω without damping (2.62/ω at ξ = 0.5, 2.78/2d if damping dominates).
#include "sim/integrate/integrator.h"
#include "sim/integrate/vertex_loop.h"

#include <cmath>
#include <limits>

namespace rend {
namespace {

// The weighted sums of the stages' velocities and accelerations, one per vertex slot.
struct Sums {
  std::vector<Record> velocity, acceleration; // [m/s], [m/s²]
};

// Adds the derivative at a stage (its forces, its velocities) with its weight; the first stage sets the sums.
// Then computes the next stage, at `ahead` from the start, possibly in place.
template <bool first>
REND_INLINE void collect(std::size_t begin, std::size_t end, const System& system, const Record* force,
                         const Record* velocity, double weight, const StateView& now, double ahead, Sums& sums,
                         State& stage) {
  const Double4 w = splat(weight), h = splat(ahead);
  for (std::size_t i = begin; i < end; ++i) {
    const Double4 v = load(velocity[i]), a = system.acceleration(i, load(force[i]), v);
    store(sums.velocity[i], first ? v : load(sums.velocity[i]) + w * v);
    store(sums.acceleration[i], first ? a : load(sums.acceleration[i]) + w * a);
    store(stage.position[i], load(now.position[i]) + h * v);
    store(stage.velocity[i], load(now.velocity[i]) + h * a);
  }
}
REND_INLINE void collect_first(std::size_t begin, std::size_t end, const System& system, const Record* force,
                               const StateView& now, double ahead, Sums& sums, State& stage) {
  collect<true>(begin, end, system, force, now.velocity, 1, now, ahead, sums, stage);
}
REND_INLINE void collect_middle(std::size_t begin, std::size_t end, const System& system, const Record* force,
                                const StateView& now, double ahead, Sums& sums, State& stage) {
  collect<false>(begin, end, system, force, stage.velocity.data(), 2, now, ahead, sums, stage);
}
REND_INLINE void finish(std::size_t begin, std::size_t end, const System& system, const Record* force,
                        const StateView& now, double step, const Sums& sums, const State& stage, State& next,
                        Double4& probe) {
  Double4 seen = probe;
  const Double4 sixth = splat(step / 6);
  for (std::size_t i = begin; i < end; ++i) {
    const Double4 v = load(stage.velocity[i]), a = system.acceleration(i, load(force[i]), v);
    next.write(i, load(now.position[i]) + sixth * (load(sums.velocity[i]) + v),
               load(now.velocity[i]) + sixth * (load(sums.acceleration[i]) + a), seen);
  }
  probe = seen;
}

class RungeKutta4 final : public Integrator {
  State stage_;
  std::vector<Record> force_; // [N], of the stage
  Sums sums_;

  std::size_t bytes() const override {
    return stage_.bytes() + bytes_of(force_) + bytes_of(sums_.velocity) + bytes_of(sums_.acceleration);
  }

  void advance(System& system, double time, double step, const StateView& now, const Record* force,
               State& next) override {
    const std::size_t count = system.vertices();
    force_.resize(count);
    stage_.resize(count);
    sums_.velocity.resize(count);
    sums_.acceleration.resize(count);
    over_vertices<collect_first>(system, force, now, 0.5 * step, sums_, stage_);
    evaluate(system, time + 0.5 * step);
    over_vertices<collect_middle>(system, force_.data(), now, 0.5 * step, sums_, stage_);
    evaluate(system, time + 0.5 * step);
    over_vertices<collect_middle>(system, force_.data(), now, step, sums_, stage_);
    evaluate(system, time + step);
    write_vertices<finish>(system, next, force_.data(), now, step, sums_, stage_);
    system.constrain(time + step, next.position.data(), next.velocity.data());
  }

  void evaluate(System& system, double time) {
    system.constrain(time, stage_.position.data(), stage_.velocity.data());
    system.forces(time, stage_.position.data(), stage_.velocity.data(), force_.data());
  }
};

double limit_rk4(const StabilityBounds& b) {
  const double d = b.damping_rate / 2;
  const double speed = std::sqrt(b.omega_squared + d * d) + d;
  return speed > 0 ? 2.6 / speed : std::numeric_limits<double>::infinity();
}

} // namespace

Scheme runge_kutta_4() {
  return {.name = "rk4",
          .what = "the classical Runge-Kutta scheme",
          .order = 4,
          .evaluations = 4,
          .limit = &limit_rk4,
          .make = &make_integrator<RungeKutta4>};
}

} // namespace rend
