// `rend study --lean`: what each feature costs in time and bytes, and whether it has no effect where it must
// have none.
#pragma once

#include "render/studies/lean_features.h"
#include "sim/preset/override.h"
#include "sim/study/paired_timing.h"

namespace rend {

struct LeanRow {
  std::string scene, feature, what;
  std::string refused; // why it is not measured on this scene; empty: it is
  LeanSame same = LeanSame::State;
  Comparison time;
  std::size_t bytes_off = 0, bytes_on = 0; // of all arrays
  bool same_state = false, same_pixels = false;

  bool measured() const { return refused.empty(); }
  bool as_required() const; // states or pixels are equal where they must be
};

struct LeanPlan {
  std::vector<LeanScene> scenes;
  std::vector<Override> overrides; // for all scenes
  int builds = 9;                  // repetitions, building both scenes
  int pairs = 4;                   // pairs of runs per build
  double seconds = 0.02;           // duration of each run
};

// One row for each feature on each scene. Throws UserError if a scene cannot be built; StopRequested.
std::vector<LeanRow> run_lean(const LeanPlan& plan, const StudyCalls& calls);

} // namespace rend
