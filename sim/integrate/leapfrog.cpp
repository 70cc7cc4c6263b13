#include "sim/integrate/leapfrog.h"

#include "sim/integrate/vertex_loop.h"

namespace rend {
namespace {

// `kick` [s]: h, or h/2.
REND_INLINE void drift_range(std::size_t begin, std::size_t end, const System& system, double step, double kick,
                             const StateView& now, const Record* force, State& next, Double4& probe) {
  Double4 seen = probe;
  const Double4 h = splat(step), k = splat(kick);
  for (std::size_t i = begin; i < end; ++i) {
    const Double4 v = load(now.velocity[i]), u = v + k * system.acceleration(i, load(force[i]), v);
    next.write(i, load(now.position[i]) + h * u, u, seen);
  }
  probe = seen;
}

// w = u + share (u − v), which is v' if forces stay.
REND_INLINE void predict_velocity(std::size_t begin, std::size_t end, const System&, double share,
                                  const StateView& now, State& next) {
  const Double4 c = splat(share);
  for (std::size_t i = begin; i < end; ++i) {
    const Double4 u = load(next.velocity[i]);
    store(next.velocity[i], u + c * (u - load(now.velocity[i])));
  }
}

REND_INLINE void kick_range(std::size_t begin, std::size_t end, const System& system, double step, double share,
                            const StateView& now, const Record* force, State& next, Double4& probe) {
  Double4 seen = probe;
  const Double4 c = splat(share), of_w = splat(1 / (1 + share)), half_step = splat(0.5 * step);
  for (std::size_t i = begin; i < end; ++i) {
    const Double4 w = load(next.velocity[i]), u = of_w * (w + c * load(now.velocity[i]));
    next.write(i, load(next.position[i]), u + half_step * system.acceleration(i, load(force[i]), w), seen);
  }
  probe = seen;
}

} // namespace

void drift(System& system, double time, double step, const StateView& now, const Record* force, State& next) {
  write_vertices<drift_range>(system, next, step, now.staggered ? step : 0.5 * step, now, force);
  system.constrain(time + step, next.position.data(), next.velocity.data());
}

void kick(System& system, double time, double step, const StateView& now, State& next,
          std::vector<Record>& force) {
  force.resize(system.vertices());
  const double share = now.staggered ? 0.5 : 1;
  over_vertices<predict_velocity>(system, share, now, next);
  system.constrain(time + step, next.position.data(), next.velocity.data());
  system.forces(time + step, next.position.data(), next.velocity.data(), force.data());
  next.probe = Double4{};
  write_vertices<kick_range>(system, next, step, share, now, force.data());
  system.constrain(time + step, next.position.data(), next.velocity.data());
}

} // namespace rend
