// A scene: bodies, their surroundings, and time. step() advances the state.
#pragma once

#include "sim/contact/contacts.h"
#include "sim/guard/step_failure.h"
#include "sim/scene/definition.h"
#include "sim/scene/energy_account.h"
#include "sim/scene/kept_state.h"

#include <functional>
#include <optional>

namespace rend {

struct FrequencyBounds;

struct SceneOptions {
  bool walk = false; // --kernels walk
  int threads = 1;
  bool count_fragments = false; // events count fragments
  // Somebody may set the state between steps: where a stretch of steps is to be redone, it is found out.
  bool set_between_steps = true;
  bool guard = true; // false: failed steps are not redone; a state that is not finite still stops the run
  std::optional<Fault> fault = {};
  bool reach = false;                  // no body tears: the largest values of all criteria are found instead
  std::optional<long> look_every = {}; // steps between looks at the largest values of laws; none: set_looks()
  std::optional<long> steps = {};      // of the run, where it does not last as long as the scene says
  bool profile = false;                // every step is timed (base/profile.h)
  bool parallel_small_bodies = false;  // ProgramOptions
};

// Wall clock [s]; those of step() from the scene's profile: `forces` includes loads, `integrate` the solver,
// contact and the guard.
struct SceneSeconds {
  double build = 0, bind = 0, forces = 0, criteria = 0, change = 0, rebind = 0, integrate = 0;
};

struct Unstable : UserError {
  using UserError::UserError;
};

class Guard;
class VertexBounds;

class Scene {
public:
  // UserError (BadInput) if its parts do not fit together.
  Scene(SceneDefinition definition, const SceneOptions& options);
  ~Scene();

  const std::string& name() const { return name_; }
  const World& world() const { return world_; }
  const std::vector<std::unique_ptr<Body>>& bodies() const { return bodies_; }

  // null: no body has contact with more than the floor
  const Contacts* contacts() const { return contacts_.get(); }

  double time() const; // [s]
  long steps_done() const { return steps_done_; }
  double step_size() const { return step_; } // [s]
  double duration() const { return duration_; }
  const Scheme& scheme() const { return *time_.scheme; }
  const std::vector<std::string>& notes() const { return notes_; } // without those of bodies
  bool automatic_step() const { return !time_.step; }

  // One step; if it fails, the guard redoes the last ones with substeps (guard.h). Throws Unstable (exit 76) if
  // that does not help, with the positions and velocities before the step restored; changes of topology at its
  // start are kept. Throws StopRequested before or within a step that takes long: it is as if it had not begun,
  // except that its laws may have been applied.
  void step();
  // False after a stop within laws, or within a step without a guard: what came of it is no state of the run.
  bool can_be_stored() const { return can_be_stored_; }

  // Calls `show` with the current state, once it is certain that the steps which led to it will not be redone:
  // at once, within a later step() or in settle(). Meanwhile the state is kept (kept_state.h). If it throws,
  // the scene is unusable.
  void show_when_settled(std::function<void()> show);
  bool is_settled() const;                             // certain already
  bool keeps_states() const { return !kept_.empty(); } // not shown yet
  // Ends the stretch of steps, as at the end of a run; may redo steps, and throw as step() does. All that is
  // kept is shown.
  void settle();
  // After a stop: goes back to the last state that is certain, and forgets those that are kept.
  void return_to_settled();

  // Without a guard: throws Unstable if the step does not resolve the motion of the current state. Called
  // before a state is shown.
  void check_sound() const;
  // At the end of a run: throws Unstable if more energy appeared without a cause than most_gained_share. Costs
  // as much as energy().
  void check_account() const;
  const GuardFigures& guard() const;
  std::size_t guard_bytes() const;

  // The largest step [s] for which a scheme is certainly stable here; 0: none, infinity: any.
  double stability_limit(const Scheme& scheme) const;

  std::size_t tears() const;
  std::size_t fragments() const; // walks the maps
  long evaluations() const;      // of internal forces, of all bodies, for all steps so far
  // Of bodies, and of falling spheres.
  double kinetic_energy() const;
  double elastic_energy() const;
  double gravity_energy() const; // in the gravity of the current time
  // Evaluates forces and elastic energy of all bodies, without counting them. Changes nothing.
  EnergyFigures energy() const;
  double mass() const;
  Vec3 momentum() const;
  Vec3 angular_momentum() const;
  std::uint64_t hash() const; // of positions, velocities and topology, and of spheres that move
  SceneSeconds seconds() const;
  Profile& profile() const { return *profile_; }

  // Checkpoint, between steps: everything that later steps, events or figures depend on, written, or read into
  // a scene with the same preset and options that is no further. It then continues identically to the bit. The
  // bytes may be malicious: they are checked before use, and impossible states are refused. Throws ArchiveError
  // for those, or for another scene; this one is then unusable.
  void store(Archive& archive);

private:
  EnergyState energy_state() const;
  void set_step();
  [[noreturn]] void refuse_so_many_steps() const;
  void set_looks(const SceneOptions& options);
  void set_answers();
  void measure_answers();
  void forget_answers();   // those later than the current time
  void check_read() const; // throws ArchiveError
  void check_contact();
  void solve_contact(); // of bodies whose scheme solves it
  void scale_masses();
  double stable_step();
  SchemeSettings checked_settings() const;
  double stability_limit() const; // [s]
  double limit_until_torn();      // [s]: as long as no body that grows is torn
  FrequencyBounds bounds_until_torn(std::size_t body);
  double limit_by(const Scheme& scheme,
                  const std::function<FrequencyBounds(std::size_t body)>& bounds_of) const;
  [[noreturn]] void stop_crossing(const ThroughEachOther& through) const;
  [[noreturn]] void stop(const Body& body, const std::string& what) const;
  [[noreturn]] void stop(const Body& body, const std::string& what, const std::string& hint) const;
  void reach(long goal); // steps done
  StepFailure try_step();
  void keep_again();
  bool has_states_to_show() const;
  void show_settled();
  void keep_solver_states();
  void return_to_start_of(long step);
  StepFailure nominal_step();
  StepFailure substep(double time, double step); // [s]
  void evaluate_forces();
  StepFailure apply_laws();
  int parts_within(double limit) const;
  bool touches_by_verlet() const;
  bool divides_for_bounds() const;
  void divide_for_contact();
  StepFailure integrate(double time, double step);        // [s]
  StepFailure resolve_contacts(double time, double step); // [s]
  void apply_contacts(double time, double step);
  void commit(double step); // [s]
  bool finite() const;
  void redo(StepFailure failure, long entry);
  bool state_was_set();
  void return_to(long step);
  void arm_fault();
  [[noreturn]] void fail_step(StepFailure failure, long entry);
  std::string find_non_finite(const Body*& body);

  std::string name_;
  World world_;
  std::unique_ptr<Profile> profile_;
  std::vector<std::unique_ptr<Body>> bodies_;
  std::vector<std::unique_ptr<VertexBounds>> bounds_; // of bodies that grow and were torn; null: of others
  std::unique_ptr<Contacts> contacts_;                // null: no body has contact with more than the floor
  TimeSettings time_;
  double duration_ = 0; // [s]
  Place step_place_;    // in the preset, for messages
  double step_ = 0;     // [s]
  long steps_done_ = 0;
  double next_answer_ = std::numeric_limits<double>::infinity(); // [s], when the next one is due
  std::vector<std::string> notes_;
  double build_seconds_ = 0, bind_seconds_ = 0;
  std::unique_ptr<Guard> guard_;
  EnergyAccount account_; // of scenes without inertia (static): never opened
  // why the last attempt of the step failed; nullopt: it did not, or it is not finite
  std::optional<NotConverged> not_converged_;
  bool finds_set_states_ = true;
  std::vector<KeptState> kept_; // in order of their steps
  long laws_applied_at_ = -1;   // steps_done() when the laws were last applied
  std::vector<State> current_;  // scratch, one per body
  std::optional<Fault> fault_;
  std::vector<std::vector<double>> solver_states_; // per body, at the start of a step of a scheme that solves
  bool returning_ = false;                         // steps are repeated that have been made before
  bool can_be_stored_ = true;
};

} // namespace rend
