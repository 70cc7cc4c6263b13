// A study: one preset run by several schemes at several steps, comparing error and run time.
//
//   plan -> groups × schemes × knobs -> a reference for each group -> runs -> rows -> curves (orders, times)
//
// A group is one combination of all other swept settings (mesh, model, rotation ...). Its runs are compared
// with its own reference, so that their errors are those of the scheme alone; the distance of its reference
// from that of the most accurate group is the error of the mesh or the model. Nothing here reads or writes
// files: scenes come from a function, and results are returned.
#pragma once

#include "sim/base/stop_request.h"
#include "sim/study/errors.h"
#include "sim/study/order_fit.h"
#include "sim/study/pareto.h"

#include <functional>
#include <memory>

namespace rend {

// A replaced attribute of the preset, as with --set.
struct Setting {
  std::string path, value;
};

// A variant of the scene. Everything else is as in the preset.
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
  std::vector<StudyGroup> groups;       // at least one; the first is taken as the most accurate
  int steps = 7;                        // below each scheme's limit, over two decades
  double duration = 0;                  // [s]; 0: by the rule of study_duration()
  int reruns = 7;                       // timed runs of each, after an untimed one
  bool above_limit = true;              // two steps above the limit, to show their failure
};

// Astray: it completed, but its error is as large as that of a body that never moved.
enum class Outcome { Done, Unstable, NotConverged, Inaccurate, Refused };
const char* name_of(Outcome outcome); // "done", "unstable" ...

// Seconds of the time loop alone, in CPU time of its thread.
struct RunTime {
  double median = 0, low = 0, high = 0; // [s]; low and high: the fastest and the slowest
  double quartiles = 0;                 // [s], between the first and the third
  int runs = 0;
};

// The cost of a run, independent of the machine.
struct RunCounts {
  long evaluations = 0; // of the forces
  long newton = 0, cg = 0, factorisations = 0;
  long substeps = 0, rejected = 0; // of adaptive schemes
};

struct StudyRow {
  std::size_t group = 0;
  std::string integrator;
  double step = 0, limit = 0;      // [s]; the largest step that is certainly stable, infinite if all are
  long steps = 0, steps_done = 0;  // planned, and made
  std::optional<double> tolerance; // of adaptive schemes
  bool above_limit() const { return step > limit; }

  Outcome outcome = Outcome::Done;
  std::string reason; // of a failure
  bool failed() const { return outcome != Outcome::Done; }

  std::optional<StateErrors> errors; // absolute; nullopt for a failed run
  double error = 0;                  // of position, over time, relative to Scales: the value plotted
  // the same against the first group's reference, if there are several groups
  std::optional<double> total_error;
  double velocity_error = 0, energy_error = 0; // relative, too
  bool doubtful = false;                       // less than ten times the reference's error bar
  bool on_front = false;                       // on the Pareto front of its group

  RunTime time;
  RunCounts counts;
  std::size_t tears = 0;
  std::optional<double> first_tear; // [s]
  double torn_overlap = 1;          // overlap with the reference's torn sides
  std::vector<AnswerError> answers;

  double mean_step() const; // [s], including the substeps of the scheme
};

// The reference of a group.
struct StudyReference {
  std::string scheme, second;       // how it was computed, in plain language
  double step = 0, second_step = 0; // [s]
  double bar = 0;                   // distance of the two schemes: error of position over time, relative
  double smallest = 0;              // smallest error among the completed rows, relative
  bool good_enough() const { return bar <= 0.1 * smallest; }
  Scales scales;
  std::size_t vertices = 0, elements = 0, tears = 0;
  std::optional<double> first_tear, second_first_tear; // [s]
  double torn_overlap = 1;                             // of both schemes
  std::optional<double> distance; // from the first group's reference, in the scales of that one
};

// The runs of one scheme in one group.
struct StudyCurve {
  std::size_t group = 0;
  std::string integrator;
  int theory = 0;                          // theoretical order
  std::vector<std::size_t> rows;           // by decreasing step
  std::optional<OrderFit> fit;             // its `used` are indices into the report's rows
  std::vector<std::optional<Reach>> reach; // one per target
};

struct StudyReport {
  double duration = 0;      // [s], that was run
  double clip = 0;          // [s], of the preset
  std::string why_duration; // how it was chosen, in plain language
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

// Throws UserError if the preset cannot be built or run at all; StopRequested if `going` returned false.
StudyReport run_study(const StudyPlan& plan, const MakeScene& make, const StudyCalls& calls);

// The curves, fronts and marks of a report whose rows and references are complete.
void conclude(StudyReport& report);

} // namespace rend
