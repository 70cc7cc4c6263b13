// The figures of a run: one struct, filled once, and its printers. The names of the JSON object of `--json` are
// a contract with tests, benchmarks and `rend batch`.
#pragma once

#include "render/clip/missed_obstacles.h"
#include "render/clip/printed_figures.h"
#include "render/clip/session.h"
#include "render/pipeline/pipeline.h"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rend {

// Costs of a run outside the time loop.
struct Costs {
  double total = 0;         // [s], from reading the preset on
  double surface = 0;       // [s]
  PipelineSeconds pictures; // [s]
  std::size_t surface_bytes = 0;
};

// Why a law has torn nothing. Its largest value is that within its time, of the cells that it selects.
enum class NeverTore {
  No,          // it has torn something
  NotInTime,   // no step was in its time
  NoValue,     // nothing was above 0
  Below,       // the largest value is below the threshold
  NotPossible, // the threshold was exceeded where the change was not possible: `refusals`
};
std::string_view name_of(NeverTore why); // of JSON

// What a law did, whether it did anything or not.
struct LawFigures {
  std::string body, criterion, change;
  double threshold = 0;
  std::string unit; // of that
  std::size_t tears = 0;
  std::optional<double> first; // [s], of the first tear
  // The step of that, counted from the law's start, if it is one of the first and the threshold far below what
  // is reached: it may be meant in another unit (early_tears.h).
  std::optional<long> at_once;
  NeverTore never = NeverTore::No;
  double from = 0, until = 0; // [s]; until: infinite without an end
  bool selects = false,
       is_relative = false; // among some vertices alone; values are divided by the strength there
  Refusals refusals;        // where the value was above the threshold and the change not possible, by reason
  Reached reached;          // the largest value
  long look_every = 1;      // steps; of values above the threshold 1
};

// The largest value of a criterion at the steps at which its law has looked.
struct ReachFigures {
  std::string body, criterion; // with the kind of springs
  std::string unit;
  long look_every = 1; // steps
  Reached reached;
};

// Fragments by their share of the mass of all.
struct FragmentFigures {
  static constexpr double small = 0.01;        // the share below which a fragment is small
  std::size_t count = 0, above = 0, below = 0; // above: beside the largest; below: `small`
  double largest = 0;                          // share; 0: there is none
};

struct ProbeFigures {
  std::string name;
  std::optional<ProbeReading> reading; // none: its vertices were deleted
};

struct AnswerFigures {
  std::string probe, quantity;
  double at = 0;    // [s]
  double value = 0; // [m], [N] or [Pa]
  double tolerance = 0;
  std::optional<double> measured, error; // none: not reached, or its vertices were deleted
  std::optional<bool> holds;             // none: not reached
  std::string source;
};

struct SphereFigures {
  Vec3 centre, velocity; // [m], [m/s]
};

// What the integrators' solving took, over all bodies.
struct SolvingFigures {
  SolverFigures all; // bytes: with those of the assembled matrix
  std::size_t blocks = 0;
};

// All that a state is known by.
struct StateFigures {
  long steps = 0, evaluations = 0; // evaluations: of internal forces
  double time = 0;                 // [s]
  std::size_t vertices = 0, elements = 0, darts = 0, tears = 0;
  FragmentFigures fragments;
  std::vector<LawFigures> laws;
  std::vector<ReachFigures> reach; // of all criteria; empty unless asked for
  EnergyFigures energy;
  bool falling = false;                                   // whether `energy` counts falling spheres, too
  double mass = 0;                                        // [kg]
  std::vector<std::pair<std::string, double>> added_mass; // [kg], of each body that mass scaling made heavier
  Vec3 momentum, angular_momentum;                        // [kg m/s], [kg m²/s]
  std::vector<ProbeFigures> probes;
  std::vector<AnswerFigures> answers;
  std::optional<bool> touched_nothing;    // missed_obstacles.h
  std::vector<ObstacleFigures> obstacles; // likewise; empty: none that a body collides with
  std::vector<SphereFigures> spheres;     // those that move, in the order of the preset
  GuardFigures guard;
  std::optional<CrossingFigures> crossings; // none: no faces in contact, or a scheme that solves
  std::vector<std::pair<std::string, std::size_t>>
      rows;                              // live ones that the integrator evaluates, by interaction
  std::optional<SolvingFigures> solver;  // none: the scheme does not solve
  std::optional<SolverFigures> adaptive; // none: the scheme does not cut its steps
  std::uint64_t hash = 0;
};

// [byte]
struct MemoryFigures {
  std::size_t map = 0, embeddings = 0, program = 0, state = 0, surroundings = 0, surface = 0, guard = 0;
  std::size_t peak = 0; // of the process
  std::size_t of_scene() const { return map + embeddings + program + state + surroundings + surface + guard; }
};

// States that were exported (export_series.h).
struct ExportFigures {
  std::string format, folder, index; // index: empty where the format has none
  std::size_t files = 0, bytes = 0;
  double seconds = 0;
};

struct Figures {
  std::string preset, name, integrator;
  double step = 0; // [s]
  Stopped stopped = Stopped::No;
  // Not: all pictures were there. What the state would come to is not known, and its figures are printed as
  // null.
  bool simulated = true;
  StateFigures state;
  SceneSeconds seconds;
  double step_seconds = 0;
  Costs costs;
  MemoryFigures bytes;
  std::optional<ExportFigures> exported;
  std::optional<PictureFigures> pictures;
};

// Of the present state: the last good one where the run was stopped. What is exported or drawn is left to the
// caller.
Figures figures_of(const Session& session, Stopped stopped, const Costs& costs);

nlohmann::ordered_json json_of(const Figures& figures);
std::string summary_of(const Figures& figures); // to be read

} // namespace rend
