#include "sim/integrate/lowest_eigenvalue.h"

#include "sim/integrate/rigid_motions.h"

#include <cmath>
#include <limits>

namespace rend {
namespace {

constexpr double first_shift = 1e-9, most_shift = 64, shift_grows = 4; // relative to the mean stiffness
constexpr int most_inverse_iterations = 100;
constexpr double steady = 1e-4, eigen_digits = 1e-8; // tolerances of λ + s, and of a linear system

// Sets the matrix to A + s M with constraints, with the smallest s that makes it positive definite [1/s²]; 0:
// none did.
double shifted(const Equilibrium& at, BlockMatrix& matrix, LinearSolver& linear) {
  const std::size_t count = at.position.size();
  const double* inverse_mass = at.system.inverse_mass;
  for (double share = first_shift; share <= most_shift; share *= shift_grows) {
    matrix.reset(at.system.pattern());
    at.system.add_stiffness(at.position.data(), at.still.data(), Tangent::Exact, 1, 0, matrix);
    const double shift = share * mean_stiffness(matrix, inverse_mass, count);
    for (std::size_t i = 0; i < count; ++i)
      matrix.add_diagonal(i, inverse_mass[i] != 0 ? shift / inverse_mass[i] : 1);
    matrix.constrain(at.held.data());
    linear.set_matrix(matrix);
    if (linear.factorise() == Definiteness::Positive) return shift;
  }
  return 0;
}

// A start vector without symmetries, the same on every machine; 0 at constrained coordinates and free slots.
Records start_of(const Equilibrium& at) {
  Records out(at.position.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (at.system.inverse_mass[i] == 0) continue;
    const auto part = [&](std::size_t n) {
      return static_cast<double>((3 * i + n) * 7919 % 1009) / 1009 - 0.4;
    };
    store(out[i], free_axes(at.held[i]) * Double4{part(0), part(1), part(2), 0});
  }
  return out;
}

// M x
void weigh(const System& system, const Records& x, Records& out) {
  out.assign(x.size(), Record{});
  for (std::size_t i = 0; i < x.size(); ++i)
    if (system.inverse_mass[i] != 0) store(out[i], splat(1 / system.inverse_mass[i]) * load(x[i]));
}

} // namespace

double lowest_eigenvalue(const Equilibrium& at, BlockMatrix& matrix, LinearSolver& linear,
                         LoadTangent& tangent) {
  constexpr double unknown = -std::numeric_limits<double>::infinity();
  const double shift = shifted(at, matrix, linear);
  if (shift == 0) return unknown;
  const int parts = at.system.pattern()->parts;
  tangent.at(at.system, at.time, at.position, at.still, at.held, {});
  tangent.with_forces(matrix, shift);
  Records mode = start_of(at), weighed, next(mode.size());
  double found = unknown;
  for (int n = 0; n < most_inverse_iterations; ++n) {
    weigh(at.system, mode, weighed);
    const double size = std::sqrt(dot(parts, mode, weighed));
    if (!(size > 0) || !std::isfinite(size)) return unknown;
    for (Record& r : weighed) store(r, load(r) / splat(size));
    if (!tangent.solve(linear, weighed, next, eigen_digits)) return unknown;
    const double inverse = dot(parts, weighed, next); // 1/(λ + s)
    const double before = found;
    found = 1 / inverse - shift;
    mode.swap(next);
    if (std::abs(found - before) <= steady * (found + shift)) break;
  }
  return found;
}

} // namespace rend
