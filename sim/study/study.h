// A study: one preset run by several schemes at several steps, each run's error against its run time.
//
//   plan -> groups × schemes × knobs -> a reference for each group -> runs -> rows -> curves (orders, times)
//
// A group is one value of everything else that is swept (mesh, model, rotation ...). Its runs are compared with
// its own reference, so that their errors are those of the scheme alone; how far its reference is from that of
// the group that counts as the most exact is what the mesh or the model does. Nothing here reads or writes
// files: scenes come from a function, and numbers go back.
#pragma once

#include "sim/study/errors.h"
#include "sim/study/order_fit.h"
#include "sim/study/pareto.h"

#include <functional>
#include <memory>

namespace rend {

// An attribute of the preset replaced: as in --set.
struct Setting {
  std::string path, value;
};

// One scene to be built. What is not said stays as the preset has it.
struct Variant {
  std::string integrator;          // empty: the preset's
  double step = 0;                 // [s]; 0: the preset's
  std::optional<double> tolerance; // of adaptive schemes
  std::vector<Setting> settings;
};
using MakeScene = std::function<std::shared_ptr<Scene>(const Variant&)>; // may throw UserError

struct StudyGroup {
  std::string name; // "body.elasticity.rotation=qr"; empty: there is only one
  std::vector<Setting> settings;
};

struct StudyPlan {
  std::vector<std::string> integrators; // names of schemes
  std::vector<StudyGroup> groups;       // at least one; the first counts as the most exact
  int steps = 7;                        // below each scheme's limit, over two decades
  double duration = 0;                  // [s]; 0: by the rule of study_duration()
  int reruns = 7;                       // timed runs of each, after one that is not
  bool above_limit = true;              // two steps above the limit, to see them fail
};

// Astray: it came to its end, and a body that never moved would be as near to the reference.
enum class Outcome { Done, Unstable, Unsolved, Astray, Refused };
const char* name_of(Outcome outcome); // "done", "unstable" ...

// Seconds of the time loop alone, by the clock of the thread that runs it, which stands still while others run.
struct RunTime {
  double median = 0, low = 0, high = 0; // [s]; low and high: the fastest and the slowest
  double quartiles = 0;                 // [s], between the first and the third
  int runs = 0;
};

// What a run took, whatever the machine.
struct RunCounts {
  long evaluations = 0; // of the forces
  long newton = 0, cg = 0, factorisations = 0;
  long parts = 0, rejected = 0; // of adaptive schemes
};

struct StudyRow {
  std::size_t group = 0;
  std::string integrator;
  double step = 0, limit = 0;      // [s]; the largest step that is surely stable, infinite if all are
  long steps = 0, steps_done = 0;  // to be done, and done
  std::optional<double> tolerance; // of adaptive schemes
  bool above_limit() const { return step > limit; }

  Outcome outcome = Outcome::Done;
  std::string reason; // of a failure
  bool failed() const { return outcome != Outcome::Done; }

  std::optional<StateErrors> errors; // absolute; none of a failed run
  double error = 0;                  // of position, over time, relative to Scales: what is plotted
  std::optional<double>
      total_error; // the same from the first group's reference, where there are several groups
  double velocity_error = 0, energy_error = 0; // relative as well
  bool doubtful = false;                       // not above ten times the reference's error bar
  bool on_front = false;                       // of its group

  RunTime time;
  RunCounts counts;
  std::size_t tears = 0;
  std::optional<double> first_tear; // [s]
  double torn_overlap = 1;          // with the reference's torn sides
  std::vector<AnswerError> answers;

  double mean_step() const; // [s], of what the scheme really took
};

// What a group is compared with.
struct StudyReference {
  std::string scheme, second;       // how it was computed, in words
  double step = 0, second_step = 0; // [s]
  double bar = 0;                   // the two schemes' distance: error of position over time, relative
  double smallest = 0;              // error among the rows that were done, relative
  bool good_enough() const { return bar <= 0.1 * smallest; }
  Scales scales;
  std::size_t vertices = 0, elements = 0, tears = 0;
  std::optional<double> first_tear, second_first_tear; // [s]
  double torn_overlap = 1;                             // of both schemes
  std::optional<double> distance; // from the first group's reference, relative to that one's scales
};

// The runs of one scheme in one group.
struct StudyCurve {
  std::size_t group = 0;
  std::string integrator;
  int theory = 0;                          // order
  std::vector<std::size_t> rows;           // by decreasing step
  std::optional<OrderFit> fit;             // its `used` are indices into the report's rows
  std::vector<std::optional<Reach>> reach; // one per target
};

struct StudyReport {
  double duration = 0;      // [s], the stretch
  double clip = 0;          // [s], of the preset
  std::string why_duration; // how the stretch was chosen, in words
  int samples = 0;
  bool tears = false, isolated = false;
  std::vector<double> targets; // errors
  std::vector<StudyGroup> groups;
  std::vector<StudyReference> references; // one per group
  std::vector<OrderRule> rules;           // one per group
  std::vector<StudyRow> rows;
  std::vector<StudyCurve> curves;
};

struct StudyCalls {
  std::function<void(const std::string& what, double share)> progress; // may be empty
  std::function<bool()> going;                                         // false: stop; may be empty
};

// Throws UserError where the preset cannot be built or run at all; Interrupted where `going` said so.
struct Interrupted {};
StudyReport run_study(const StudyPlan& plan, const MakeScene& make, const StudyCalls& calls);

// The curves, fronts and marks of a report whose rows and references are there.
void conclude(StudyReport& report);

} // namespace rend
