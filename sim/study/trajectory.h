// What a run of a scene did, at moments that all runs of a study share: so much of it that two runs can be
// compared.
//
// A body that cannot tear is sampled at its vertices. One that can is sampled at its element corners, which
// every separation leaves alone: a corner is the same matter in two runs that tore differently, and as long as
// nothing has torn the sum over corners, Σ_c m_c |Δx|², is the sum over vertices. What is deleted has no
// position any more: NaN.
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

// A side of an element that was joined to another at the start and is not any more, by its smallest dart.
struct TornSide {
  std::uint32_t body = 0;
  Dart dart;
  friend auto operator<=>(const TornSide&, const TornSide&) = default;
};

// How far an <answer> of the preset is missed: relative, or absolute where the answer is 0.
struct AnswerError {
  std::string name; // "tip dz at 0.5 s"
  double error = 0; // NaN: what was to be measured is gone
};

struct Trajectory {
  std::vector<Vec3> rest;           // [m], one per point
  std::vector<double> mass;         // [kg], one per point
  std::vector<StateSample> samples; // in the order of time, the start first
  bool tears = false;               // there are laws of tearing
  bool isolated = false;            // nothing acts from outside: momentum must stay
  std::size_t tear_count = 0;
  std::optional<double> first_tear; // [s]
  std::vector<TornSide> torn;       // at the end, increasing
  std::vector<AnswerError> answers; // those at whose time a step ended
};

// Takes the samples of one run.
class Sampler {
public:
  explicit Sampler(const Scene& scene); // at its start
  void take(const Scene& scene);        // its present state
  Trajectory finish(const Scene& scene);

private:
  // Of each body, by a dart of each vertex or corner: slots may be numbered anew in the midst of a run.
  std::vector<std::vector<Dart>> points_;
  Trajectory trajectory_;
};

bool tears(const Scene& scene);
bool isolated(const Scene& scene);

} // namespace rend
