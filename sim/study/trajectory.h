// Samples of a run at times common to all runs of a study, so that two runs can be compared.
//
// A body that cannot tear is sampled at its vertices. One that can is sampled at its element corners, which no
// separation changes: a corner is the same material point in two runs that tore differently, and as long as
// nothing has torn the sum over corners, Σ_c m_c |Δx|², is the sum over vertices. Deleted points have the
// position NaN.
#pragma once

#include "sim/scene/scene.h"

#include <optional>
#include <string>
#include <vector>

namespace rend {

// The state at one moment. One position [m] and velocity [m/s] per point.
struct StateSample {
  double time = 0; // [s]
  std::vector<Vec3> position, velocity;
  double kinetic = 0, elastic = 0, gravity = 0; // [J]
  Vec3 momentum = Vec3::Zero();                 // [kg·m/s]
  Vec3 angular_momentum = Vec3::Zero();         // [kg·m²/s], about the origin
  double energy() const { return kinetic + elastic + gravity; }
};

// A side of an element that was sewn to another at the start and no longer is, by its smallest dart.
struct TornSide {
  std::uint32_t body = 0;
  Dart dart;
  friend auto operator<=>(const TornSide&, const TornSide&) = default;
};

// The error of an <answer> of the preset: relative, or absolute if the answer is 0.
struct AnswerError {
  std::string name; // "tip dz at 0.5 s"
  double error = 0; // NaN: not measured
};

struct Trajectory {
  std::vector<Vec3> rest;           // [m], one per point
  std::vector<double> mass;         // [kg], one per point
  std::vector<StateSample> samples; // in the order of time, the start first
  bool tears = false;               // it has fracture laws
  bool isolated = false;            // no external forces: momentum is conserved
  std::size_t tear_count = 0;
  std::optional<double> first_tear; // [s]
  std::vector<TornSide> torn;       // at the end, increasing
  std::vector<AnswerError> answers; // those due at the end of a step
};

// Takes the samples of one run.
class Sampler {
public:
  explicit Sampler(const Scene& scene); // at its start
  void take(const Scene& scene);        // its current state
  Trajectory finish(const Scene& scene);

private:
  // Of each body, by a dart of each vertex or corner: slots may be renumbered during a run.
  std::vector<std::vector<Dart>> points_;
  Trajectory trajectory_;
};

bool tears(const Scene& scene);
bool isolated(const Scene& scene);

} // namespace rend
