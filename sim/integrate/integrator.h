// Time schemes (thesis 2.3.1, eq. 2.38 to 2.41; sim/README.md, "Time schemes"): one file each, listed in
// all_schemes().
#pragma once

#include "sim/integrate/system.h"

#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace rend {

// Counters of implicit and adaptive schemes.
struct SolverFigures {
  long newton = 0;         // iterations of Newton's method
  long cg = 0;             // iterations of conjugate gradients
  long factorisations = 0; // of the direct solver
  std::size_t bytes = 0;   // of matrix, factors and preconditioner
  long substeps = 0;       // substeps of an adaptive scheme
  long rejected = 0;       // substeps rejected by their error and repeated with a shorter size
};

// A step that could not be solved. The state before it is unchanged.
struct NotConverged : std::runtime_error {
  NotConverged(const std::string& what, std::string hint_) : std::runtime_error(what), hint(std::move(hint_)) {}
  std::string hint;
};

class Integrator {
public:
  virtual ~Integrator() = default;

  // One step from `now` at `time` over `step` into `next` (resized by the caller). `force` holds the internal
  // forces of `now`, which the fracture criteria have used already: no scheme evaluates them twice.
  virtual void advance(System& system, double time, double step, const StateView& now, const Record* force,
                       State& next) = 0;

  // The same if the forces of `now` are not evaluated yet: the scheme evaluates them into `force` and updates
  // each vertex while its force is still in the caches. The default evaluates all forces and calls advance().
  virtual void advance_fused(System& system, double time, double step, const StateView& now, Record* force,
                             State& next);
  virtual bool has_fused_advance() const { return false; } // whether advance_fused() is faster

  virtual SolverFigures solver() const { return {}; }
  virtual std::size_t bytes() const { return 0; } // arrays kept between steps, without the solver's

  // The internal state of a scheme besides that of the body, for checkpoints: a new scheme that is given these
  // numbers continues identically to the bit, counters included. `restore_state` takes as many numbers as
  // `saved_state` returns. False: invalid numbers; nothing changed.
  virtual std::vector<double> saved_state() const { return {}; }
  virtual bool restore_state(std::span<const double>) { return true; }

  // Whether bodies have inertia: if each step is an equilibrium, prescribed motions have neither inertia nor
  // viscosity.
  virtual bool has_inertia() const { return true; }
};

// Bounds of ω² and of damping rates over all modes; see frequency_bounds().
struct StabilityBounds {
  double omega_squared = 0;   // [1/s²]
  double damping_rate = 0;    // the largest 2ξω [1/s]
  double least_drag_rate = 0; // the smallest [1/s], of ambient viscosity alone
};

// The parameters of a scheme.
struct SchemeSettings {
  double tolerance = 1e-6;   // adaptive schemes: the error of a substep relative to `size`
  double size = 1;           // [m], of the body
  double rho_infinity = 0.5; // generalised-alpha: what a step leaves of motion that it does not resolve, 0 to 1
};

// Where contact acts in a step of a scheme (leapfrog.h): on its result; or within it, and within the step that
// takes its place where something touches.
enum class ContactIn { Result, Step, StepInstead };

struct Scheme {
  std::string name, what;
  int order = 1;
  int evaluations = 1;                     // of the forces, per step
  double (*limit)(const StabilityBounds&); // the largest stable step [s]; 0: none is stable; infinity: all are
  std::unique_ptr<Integrator> (*make)(const SchemeSettings& settings);
  bool solves = false; // implicit: needs the stiffness matrix; `evaluations` is the minimum per step
  bool solves_contact =
      false;             // together with the forces (System::begin_solve); otherwise it acts after the step
  bool adaptive = false; // chooses substeps by their error; `evaluations` is the minimum per step
  // The scheme keeps K + U + shadow · h Σ v·F rather than K + U (its shadow Hamiltonian to first order in the
  // step h; exact for linear forces)
  double shadow = 0;
  // Further: − force_shadow · h² Σ F²/m, exact for linear forces in velocity Verlet.
  double force_shadow = 0;
  ContactIn contact = ContactIn::StepInstead;
  bool hands_on_acceleration = false;                   // from step to step: State::acceleration
  bool takes_rho_infinity = false;                      // SchemeSettings::rho_infinity
  bool has_account() const { return name != "static"; } // of energy: where bodies have inertia
};

const std::vector<Scheme>& all_schemes();
const Scheme* find_scheme(const std::string& name); // null: no such scheme

Scheme explicit_euler();
Scheme symplectic_euler();
Scheme velocity_verlet();
Scheme midpoint();
Scheme runge_kutta_4();
Scheme runge_kutta_45();
Scheme implicit_euler();
Scheme tr_bdf2();
Scheme generalised_alpha();
Scheme static_solve();

// Scheme::make of a scheme that needs no settings.
template <class Made> std::unique_ptr<Integrator> make_integrator(const SchemeSettings&) {
  return std::make_unique<Made>();
}

bool is_whole_count(double number); // that a long was once: of those that a step hands on

// Limits used by several schemes. ω and d = ξω are bounded separately, since they belong to different modes:
double limit_symplectic(const StabilityBounds& bounds); // 2/(√(ω²+d²) + d)
double limit_by_drag(const StabilityBounds& bounds);    // 2d/ω² with the least d, and 1/d with the largest
double no_limit(const StabilityBounds& bounds);         // infinity

} // namespace rend
