// Time schemes (thesis 2.3.1, eq. 2.38 to 2.41; sim/README.md, "Time schemes"): one file each, and one word in
// all_schemes().
#pragma once

#include "sim/integrate/system.h"

#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace rend {

// What solving took so far.
struct SolverFigures {
  long newton = 0;         // iterations of Newton's method
  long cg = 0;             // iterations of conjugate gradients
  long factorisations = 0; // of the direct solver
  std::size_t bytes = 0;   // of matrix, factors and preconditioner
  long parts = 0;          // into which an adaptive scheme cut its steps
  long rejected = 0;       // parts whose error was too large, tried again shorter
};

// A step that could not be solved. The state before it is whole.
struct Unsolved : std::runtime_error {
  Unsolved(const std::string& what, std::string hint_) : std::runtime_error(what), hint(std::move(hint_)) {}
  std::string hint;
};

class Integrator {
public:
  virtual ~Integrator() = default;

  // One step from `now` at `time` over `step` into `next` (resized by the caller). `force` holds the internal
  // forces of `now`, which the laws have looked at already: no scheme pays an evaluation for them.
  virtual void advance(System& system, double time, double step, const StateView& now, const Record* force,
                       State& next) = 0;

  // The same where nobody looks at the forces of `now` before: the scheme asks for them itself, into `force`,
  // and each vertex moves on while its force is still in the caches. Schemes that cannot ask for all, and then
  // advance.
  virtual void sweep(System& system, double time, double step, const StateView& now, Record* force,
                     State& next);
  virtual bool sweeps() const { return false; } // and gains by it

  virtual SolverFigures solver() const { return {}; }
  virtual std::size_t bytes() const {
    return 0;
  } // of its own arrays, which stay between steps, without the solver's

  // What one step hands on to the next besides the state of the body, for those who stop and go on later: a
  // scheme made anew and given the same numbers goes on to the bit, and counts on. `carry` takes as many
  // numbers as `carried` gives. False: they are none that it could have given, and nothing was taken.
  virtual std::vector<double> carried() const { return {}; }
  virtual bool carry(std::span<const double>) { return true; }

  // Whether bodies move in time: where a step is an equilibrium, drives have neither inertia nor viscosity.
  virtual bool moves() const { return true; }
};

// ω² and damping rates that bound those of every mode; see frequency_bounds().
struct StabilityBounds {
  double omega_squared = 0;   // [1/s²]
  double damping_rate = 0;    // the largest 2ξω [1/s]
  double least_drag_rate = 0; // the smallest [1/s], of ambient viscosity alone
};

// What a scheme is made for.
struct SchemeSettings {
  double tolerance = 1e-6; // adaptive schemes: the error of a part of the step, as a share of `size`
  double size = 1;         // [m], of the body
};

struct Scheme {
  std::string name, what;
  int order = 1;
  int evaluations = 1;                     // of the forces, a step
  double (*limit)(const StabilityBounds&); // a stable step [s]; 0: there is none; infinity: all are
  std::unique_ptr<Integrator> (*make)(const SchemeSettings& settings);
  bool solves = false;   // needs stiffness; its evaluations are the least a step takes
  bool adaptive = false; // cuts steps into parts by their error; its evaluations are the least, too
};

const std::vector<Scheme>& all_schemes();
const Scheme* find_scheme(const std::string& name); // null: there is none

Scheme explicit_euler();
Scheme symplectic_euler();
Scheme velocity_verlet();
Scheme midpoint();
Scheme runge_kutta_4();
Scheme runge_kutta_45();
Scheme implicit_euler();
Scheme static_solve();

// Scheme::make of a scheme that needs no settings.
template <class Made> std::unique_ptr<Integrator> make_integrator(const SchemeSettings&) {
  return std::make_unique<Made>();
}

bool is_whole_count(double number); // that a long was once: of those that a step hands on

// Limits that schemes share. With ω and d = ξω bounded separately, since they belong to different modes:
double limit_symplectic(const StabilityBounds& bounds); // 2/(√(ω²+d²) + d)
double limit_by_drag(const StabilityBounds& bounds);    // 2d/ω² with the least d, and 1/d with the largest
double no_limit(const StabilityBounds& bounds);         // infinity

} // namespace rend
