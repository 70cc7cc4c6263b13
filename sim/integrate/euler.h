// What explicit and symplectic Euler share: one evaluation of the forces a step, with which each vertex moves
// on by itself,
//
//   v' = v + dt a(x, v),   x' = x + dt v   or   x' = x + dt v'
#pragma once

#include "sim/integrate/integrator.h"
#include "sim/integrate/vertex_loop.h"

namespace rend {

enum class MovesBy { OldVelocity, NewVelocity };

template <MovesBy by>
REND_INLINE void euler_move(std::size_t begin, std::size_t end, const System& system, double step,
                            const StateView& now, const Record* force, State& next, Double4& probe) {
  const Double4 h = splat(step);
  Double4 seen = probe;
  for (std::size_t i = begin; i < end; ++i) {
    prefetch<2048>(now.velocity + i);
    const Double4 v = load(now.velocity[i]);
    const Double4 w = v + h * system.acceleration(i, load(force[i]), v);
    next.write(i, load(now.position[i]) + h * (by == MovesBy::OldVelocity ? v : w), w, seen);
  }
  probe = seen;
}

template <MovesBy by> class Euler final : public Integrator {
  void advance(System& system, double time, double step, const StateView& now, const Record* force,
               State& next) override {
    write_vertices<euler_move<by>>(system, next, step, now, force);
    system.constrain(time + step, next.position.data(), next.velocity.data());
  }
  void advance_fused(System& system, double time, double step, const StateView& now, Record* force,
                     State& next) override {
    sweep_vertices<euler_move<by>>(system, time, next, step, now, force);
    system.constrain(time + step, next.position.data(), next.velocity.data());
  }
  bool has_fused_advance() const override { return true; }
};

} // namespace rend
