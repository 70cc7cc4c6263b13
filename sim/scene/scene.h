// A scene: bodies, their surroundings, and the time. step() goes from one state to the next.
#pragma once

#include "sim/contact/contacts.h"
#include "sim/guard/trouble.h"
#include "sim/scene/definition.h"

#include <optional>

namespace rend {

struct SceneOptions {
  bool walk = false; // --kernels walk
  int threads = 1;
  bool births = false; // events tell how many fragments there are
  bool guard = true;   // false: what goes wrong is not redone; what is not finite still stops the run
  std::optional<Fault> fault = {};
  bool profile = false;        // every step is timed (base/profile.h)
  bool small_in_parts = false; // ProgramOptions
};

// Wall clock [s]; those of step() by the scene's profile, of which `forces` holds loads, and `integrate` the
// solver, contact and the guard.
struct SceneSeconds {
  double build = 0, bind = 0, forces = 0, criteria = 0, change = 0, rebind = 0, integrate = 0;
};

struct Unstable : UserError {
  using UserError::UserError;
};

class Guard;

class Scene {
public:
  // UserError (BadInput) where its parts do not fit together.
  Scene(SceneDefinition definition, const SceneOptions& options);
  ~Scene();

  const std::string& name() const { return name_; }
  const World& world() const { return world_; }
  const std::vector<std::unique_ptr<Body>>& bodies() const { return bodies_; }

  const Contacts* contacts() const { return contacts_.get(); } // null: no body meets more than the floor

  double time() const; // [s]
  long steps_done() const { return steps_done_; }
  double step_size() const { return step_; } // [s]
  double duration() const { return duration_; }
  const Scheme& scheme() const { return *time_.scheme; }
  const std::vector<std::string>& notes() const { return notes_; } // besides those of bodies
  bool automatic_step() const { return !time_.step; }

  // One step; where that goes wrong the guard has the last ones redone in parts (guard.h). Throws Unstable
  // (exit 76) where that does not help, with the positions and velocities before the step whole; what tore at
  // its start stays torn.
  void step();

  // Without a guard: throws Unstable where the motion of the current state is not resolved by the step. Before
  // a state is shown.
  void check_sound() const;
  const GuardFigures& guard() const;
  std::size_t guard_bytes() const;

  // The largest step [s] that is surely stable with a scheme here; 0: none, infinity: any.
  double stability_limit(const Scheme& scheme) const;

  std::size_t tears() const;
  std::size_t fragments() const; // walks the maps
  long evaluations() const;      // of internal forces, of all bodies, for all steps so far
  // Of bodies, and of spheres that fall.
  double kinetic_energy() const;
  double elastic_energy() const;
  double gravity_energy() const;
  double mass() const;
  Vec3 momentum() const;
  Vec3 angular_momentum() const;
  std::uint64_t hash() const; // of positions, velocities and topology, and of spheres that move
  SceneSeconds seconds() const;
  Profile& profile() const { return *profile_; }

  // Between steps: all that a later step, event or figure depends on, to a scene of the same preset and options
  // that has come no further, and back (base/archive.h). It then goes on to the bit. What is read may have been
  // written by somebody who means harm: it is looked at before it is used, and what no run can come to is
  // refused. Throws ArchiveError where it is so, or of another scene; this one is spoilt.
  void store(Archive& archive);

private:
  void set_step();
  void set_answers();
  void measure_answers();
  void forget_answers();   // of later than the present time
  void check_read() const; // throws ArchiveError
  void check_contact();
  double stable_step() const;
  double checked_tolerance() const;
  double stability_limit() const; // [s]
  [[noreturn]] void stop(const Body& body, const std::string& what) const;
  [[noreturn]] void stop(const Body& body, const std::string& what, const std::string& hint) const;
  Trouble try_step();
  Trouble nominal_step();
  Trouble substep(double time, double step); // [s]
  void evaluate_forces();
  Trouble apply_laws();
  Trouble integrate(double time, double step);        // [s]
  Trouble resolve_contacts(double time, double step); // [s]
  void act_by_contacts(double time, double step);
  void commit();
  bool finite() const;
  void redo(Trouble trouble, long entry);
  bool was_set();
  void go_back(long step);
  void arm_fault();
  [[noreturn]] void give_up(Trouble trouble, long entry);
  std::string whose_number(const Body*& body);

  std::string name_;
  World world_;
  std::unique_ptr<Profile> profile_;
  std::vector<std::unique_ptr<Body>> bodies_;
  std::unique_ptr<Contacts> contacts_; // null: no body meets more than the floor
  TimeSettings time_;
  double duration_ = 0; // [s]
  Place step_place_;    // in the preset, for messages
  double step_ = 0;     // [s]
  long steps_done_ = 0;
  double next_answer_ = std::numeric_limits<double>::infinity(); // [s], to be measured
  std::vector<std::string> notes_;
  double build_seconds_ = 0, bind_seconds_ = 0;
  std::unique_ptr<Guard> guard_;
  std::optional<Unsolved> unsolved_; // why the last try of the step failed; none: it did not, or by its numbers
  long looked_ = -1;                 // steps done when laws last looked
  std::vector<State> there_;         // scratch, one per body
  std::optional<Fault> fault_;
};

} // namespace rend
