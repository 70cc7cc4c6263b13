#include "sim/integrate/integrator.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rend {

void Integrator::advance_fused(System& system, double time, double step, const StateView& now, Record* force,
                               State& next) {
  system.forces(time, now.position, now.velocity, force);
  advance(system, time, step, now, force, next);
}

bool is_whole_count(double number) {
  return number >= 0 && number <= 1e15 && number == std::floor(number);
}

const std::vector<Scheme>& all_schemes() {
  static const std::vector<Scheme> schemes{symplectic_euler(),  explicit_euler(), velocity_verlet(), midpoint(),
                                           runge_kutta_4(),     runge_kutta_45(), implicit_euler(),  tr_bdf2(),
                                           generalised_alpha(), static_solve()};
  return schemes;
}

const Scheme* find_scheme(const std::string& name) {
  for (const Scheme& scheme : all_schemes())
    if (scheme.name == name) return &scheme;
  return nullptr;
}

double limit_symplectic(const StabilityBounds& b) {
  const double d = b.damping_rate / 2;
  const double speed = std::sqrt(b.omega_squared + d * d) + d;
  return speed > 0 ? 2 / speed : std::numeric_limits<double>::infinity();
}

double limit_by_drag(const StabilityBounds& b) {
  if (b.omega_squared == 0 && b.damping_rate == 0) return std::numeric_limits<double>::infinity();
  if (b.omega_squared == 0) return 2 / b.damping_rate;
  const double by_drag = b.least_drag_rate / b.omega_squared;
  return std::min(by_drag, b.damping_rate > 0 ? 2 / b.damping_rate : by_drag);
}

double no_limit(const StabilityBounds&) {
  return std::numeric_limits<double>::infinity();
}

} // namespace rend
