// A scene: bodies, their surroundings, and the time. step() goes from one state to the next.
#pragma once

#include "sim/body/body.h"
#include "sim/contact/contacts.h"
#include "sim/guard/trouble.h"
#include "sim/outside/world.h"

#include <optional>

namespace rend {

struct SceneOptions {
  bool walk = false; // --kernels walk
  int threads = 1;
  bool births = false; // events tell how many fragments there are
  bool guard = true;   // false: what goes wrong is not redone; what is not finite still stops the run
  std::optional<Fault> fault = {};
  bool profile = false;        // where the time of steps goes is asked for
  bool small_in_parts = false; // ProgramOptions
};

// Wall-clock seconds by stage; those of step() are sampled every few steps and scaled up.
struct StageSeconds {
  double build = 0, bind = 0, forces = 0, criteria = 0, change = 0, rebind = 0, integrate = 0;
  void store(Archive& archive);
};

struct Unstable : UserError {
  using UserError::UserError;
};

class Guard;

class Scene {
public:
  // From a checked preset. UserError where it cannot be built.
  Scene(const Node& preset, const SceneOptions& options);
  ~Scene();

  const std::string& name() const { return name_; }
  const World& world() const { return world_; }
  const std::vector<std::unique_ptr<Body>>& bodies() const { return bodies_; }

  const Contacts* contacts() const { return contacts_.get(); } // null: no body meets more than the floor

  double time() const; // [s]
  long steps_done() const { return steps_done_; }
  double step_size() const { return step_; } // [s]
  double duration() const { return duration_; }
  const Scheme& scheme() const { return *scheme_; }
  const std::vector<std::string>& notes() const { return notes_; } // besides those of bodies
  bool automatic_step() const { return automatic_; }

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
  long evaluations() const; // of internal forces, of all bodies, for all steps so far
  // Of bodies, and of spheres that fall.
  double kinetic_energy() const;
  double elastic_energy() const;
  double gravity_energy() const;
  double mass() const;
  Vec3 momentum() const;
  Vec3 angular_momentum() const;
  std::uint64_t hash() const; // of positions, velocities and topology, and of spheres that move
  StageSeconds seconds() const;
  Profile* profile() const { return profile_.get(); } // null: not asked for

  // Between steps: all that a later step, event or figure depends on, to a scene of the same preset and options
  // that has come no further, and back (base/archive.h). It then goes on to the bit. What is read may have been
  // written by somebody who means harm: it is looked at before it is used, and what no run can come to is
  // refused. Throws ArchiveError where it is so, or of another scene; this one is spoilt.
  void store(Archive& archive);

private:
  void build_time(const Node& time);
  void check_probes(const Node& preset) const;
  void set_answers();
  void measure_answers();
  void forget_answers();   // of later than the present time
  void check_read() const; // throws ArchiveError
  void check_contact(const Node& preset);
  double stable_step(const Node& time) const;
  double tolerance_of(const Node& time) const;
  double stability_limit() const; // [s]
  double tearing_seconds() const;
  [[noreturn]] void stop(const Body& body, const std::string& what) const;
  [[noreturn]] void stop(const Body& body, const std::string& what, const std::string& hint) const;
  Trouble move();
  Trouble make_part(int part, int parts);
  Trouble look_at_laws();
  Trouble advance(double time, double step); // [s]
  void meet_contacts(double time, double step);
  bool finite() const;
  void redo(Trouble trouble, long entry);
  bool was_set();
  void go_back(long step);
  void arm_fault();
  [[noreturn]] void give_up(Trouble trouble, long entry);
  std::string whose_number(const Body*& body);

  std::string name_;
  World world_;
  std::unique_ptr<Profile> profile_; // null: nobody asks
  std::vector<std::unique_ptr<Body>> bodies_;
  std::unique_ptr<Contacts> contacts_; // null: no body meets more than the floor
  const Scheme* scheme_ = nullptr;
  double step_ = 0, duration_ = 0;
  bool automatic_ = false;
  long steps_done_ = 0, timed_steps_ = 0;
  double next_answer_ = std::numeric_limits<double>::infinity(); // [s], to be measured
  std::vector<std::string> notes_;
  Place step_place_; // of time.step in the preset
  StageSeconds seconds_;
  std::unique_ptr<Guard> guard_;
  std::optional<Unsolved> unsolved_; // why the last try of the step failed; none: it did not, or by its numbers
  long looked_ = -1;                 // steps done when laws last looked
  std::vector<State> there_;         // scratch, one per body
  std::optional<Fault> fault_;
};

} // namespace rend
