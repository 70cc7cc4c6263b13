// A body: a map with its embedded values, its interactions, and the data derived from them.
#pragma once

#include "sim/body/answer.h"
#include "sim/body/awaited_interactions.h"
#include "sim/body/work_meter.h"
#include "sim/boundary/boundary.h"
#include "sim/embedding/vertex_acceleration.h"
#include "sim/fracture/tear_law.h"
#include "sim/integrate/integrator.h"
#include "sim/outside/constraint.h"
#include "sim/outside/contact_settings.h"
#include "sim/outside/contact_table.h"
#include "sim/outside/injected_fault.h"
#include "sim/outside/load.h"
#include "sim/outside/solved_contact.h"
#include "sim/rows/assembly.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rend {

class Profile;

// How a body is stepped.
struct RunSettings {
  bool walk = false; // ProgramOptions
  int threads = 1;
  SchemeSettings scheme = {}; // its `size` follows from the body
};

// Of the current state.
struct BodyEnergy {
  double elastic = 0, shadow = 0; // [J]; shadow: Scheme::shadow
  Work work;
};

// What an <apply> or <subdivide> did while the body was constructed (sim/build/construction.h).
struct AppliedRule {
  std::string rule;                     // or script
  int line = 0;                         // of the element in its file; 0: it has none
  std::size_t applied = 0, skipped = 0; // places; skipped: sim/rules/rounds.h
};

enum class WitnessAt { BeforeChanges, AfterChanges };

struct Body final : System {
  std::string name;
  std::unique_ptr<EmbeddedMap> map;
  VertexGroups groups; // at the start
  MassColumn* mass = nullptr;
  DragColumn* drag = nullptr;                        // null: no viscosity per particle
  BorderColumn* border = nullptr;                    // null: the body cannot tear
  AccelerationColumn* scheme_acceleration = nullptr; // null: the scheme hands none on
  std::vector<std::unique_ptr<Interaction>> interactions;
  AwaitedInteractions awaited;
  Cumulated cumulated = Cumulated::Auto;
  Constraints constraints;
  Loads loads;
  std::function<Vec3(double time)> changing_gravity; // [m/s²] at time [s]; empty: `gravity` is constant
  double added_mass = 0;                             // [kg], by mass scaling (scene/mass_scaling.h)
  std::vector<TearLaw> tear_laws;
  long look_every = 1; // steps between looks at the largest values that the laws have reached
  long last_look = -1; // the last step of the run: a body that only watches looks there too; −1: not known
  std::optional<ContactSettings> contact; // as given by the preset
  std::optional<FloorContact> floor_contact;
  ContactTable contact_table;                    // with each thing; empty until the scene has all bodies
  std::unique_ptr<SolvedContact> solved_contact; // null: the scheme does not solve, or nothing is in its way
  std::vector<Probe> probes;
  std::vector<Answer> answers;
  std::vector<AppliedRule> applied;
  std::vector<std::string> notes;    // messages for the author of the preset
  std::vector<std::string> left_out; // what was not built for this body, and why

  std::unique_ptr<Program> program;
  std::unique_ptr<Assembly> assembly; // null: the scheme is explicit
  std::unique_ptr<Integrator> integrator;
  std::vector<Record> force;                // internal [N] at the start of the step, one per vertex slot
  mutable std::vector<Record> corner_force; // [N], one per corner slot; empty unless a criterion needs elements
  bool staggered = false;                   // the current state is (State::staggered)
  State next;      // written by the integrator: the old state stays unchanged until the step is accepted
  Changes changes; // since constraints and laws were last bound
  std::vector<TearEvent> events;
  std::function<void(WitnessAt)>
      change_observer; // called before and after a law makes its changes; may be empty
  std::unique_ptr<FragmentCounter> fragment_counter; // null: nobody asks how many fragments each change left
  std::unique_ptr<WorkMeter> work_meter;             // null: nothing does work on it
  std::optional<double> deleted_at; // [s], when the last element was deleted; the body goes on with nothing

  ~Body() override;
  bool tears() const { return !tear_laws.empty(); }

  // In place of its laws: every criterion that fits this body, with a threshold that nothing reaches. To be
  // called before prepare().
  void watch_all_criteria();

  // Builds the program and all that the time loop needs. To be called once, when everything is declared.
  void prepare(const Scheme& scheme, const RunSettings& settings = {});

  // The faces that can be seen, touched and exported, as the map is now. Made when it is first asked for, once
  // `border` is known: a body that nobody draws, touches or exports has none.
  Boundary& boundary();

  // The interface System
  std::size_t vertices() const override { return program->vertices(); }
  int parts() const override { return program->parts(); }
  void forces(double time, const Record* position, const Record* velocity, Record* out) override;
  void forces_in_ranges(double time, const Record* position, const Record* velocity, Record* out,
                        RangeFunction whole) override;
  void update_loads(double time, const Record* position, const Record* velocity) override;
  void constrain(double time, Record* position, Record* velocity) override;
  std::shared_ptr<const BlockPattern> pattern() override { return assembly->pattern(); }
  void add_stiffness(const Record* position, const Record* velocity, Tangent tangent, double by_position,
                     double by_velocity, BlockMatrix& out) override;
  void mark_prescribed(double time, std::uint8_t* axes) override;
  void begin_solve(double end, double step, const StateView& now, const Record* internal) override;
  bool in_contact() const override { return solved_contact && solved_contact->near(); }
  bool tighten_contact(const Record* position) override;

  // Of steps of `step` [s] by that scheme; `scratch`: one record per vertex slot. Leaves the loads of the
  // current state in `load`.
  BodyEnergy energy(const Scheme& scheme, double step, std::vector<Record>& scratch);
  Work work(std::vector<Record>& scratch); // CHECK: it has a meter
  void evaluate();                         // evaluates force and corner_force in the current state
  void defer_forces();                     // leaves the evaluation to advance(): if they are not needed before
  bool may_defer_forces() const;
  ForceView view() const; // of the evaluated state
  MeteredBody metered() const { return metered(force.data()); }
  MeteredBody metered(const Record* internal_force) const; // [N], one per vertex slot
  CriterionRequest request_for(const LawSettings& law) const;
  double time() const { return time_; } // [s], of the current state

  // Criteria, changes, rebinding; returns the number of changes. Calls `sound` before changing anything; it may
  // throw.
  int tear(double time, long number, const std::function<void()>& sound);
  void advance(double time, double step); // from the current state to `next`
  // A step within which contact acts (leapfrog.h): where `drifts()`, advance() makes its drift alone; elsewhere
  // drift_again() makes it in place of what advance() left. Then the kick, or `next` stays staggered.
  bool drifts() const { return drifts_always || staggered; }
  void drift_again(double time, double step);
  void kick(double time, double step);
  void rebind(); // program, constraints, laws
  void commit(); // `next` becomes the current state
  // [s]: rollback: start, of the same topology, becomes the current state
  void restore_state(const State& start, double time);
  // Of the same topology; [s]: its time, and the step that led to it.
  void exchange_state(State& other, double& time, double& last_step);
  double last_step() const { return last_step_; } // [s], that led to the current state; 0: none
  void inject_into_next();                        // fault injection, see `faulty`
  // Between steps; `done` steps of `step` [s] each. Everything that later steps depend on.
  void store(Archive& archive, long done, double step);

  long evaluations = 0; // number of evaluations of the internal forces, without those for probes
  FaultInjector faulty;

  bool drifts_always = false; // set by contacts

  // To be set before prepare().
  Profile* profile = nullptr;         // of the scene; null: none
  bool parallel_small_bodies = false; // see ProgramOptions

private:
  void make_work_meter();
  void move(double time, double step);
  void end_solved_contact();
  void measure_gravity();
  StateView current() const;
  int apply_law(std::size_t number, double time, long step, const std::function<void()>& sound);
  double energy_of_matter() const;
  // `before_closing`: see TearLaw::apply.
  int make_changes(std::size_t number, const ForceView& now, double time, long step,
                   const std::function<void()>& before_closing);
  void follow_changes();
  void take_up_interactions();
  void check_read(long done, double step) const; // throws ArchiveError
  void bind_program();
  void rebind_solved_contact();
  void reserve_for_separations();
  void clear_sums();
  void measure_elements();         // corner_force, of a body that only watches
  std::vector<Record> kick_force_; // [N], scratch
  bool forces_deferred_ = false;
  bool watches_ = false; // its laws have no threshold: nothing tears, and corner_force is that of the last look
  bool sums_ = false;    // `force` carries Program::forces_with_sums(), and corner_force is only room
  double time_ = 0, next_time_ = 0;    // [s], of the current state and of `next`
  double last_step_ = 0;               // [s], that led to the current state; 0: none
  std::unique_ptr<Boundary> boundary_; // null: nobody asked for it
};

} // namespace rend
