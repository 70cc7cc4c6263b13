// `rend study --lean`: what each feature costs, in time and bytes, and that it changes nothing where it must
// not.
#pragma once

#include "render/studies/lean_features.h"
#include "sim/preset/override.h"
#include "sim/study/paired_timing.h"

namespace rend {

struct LeanRow {
  std::string scene, feature, what;
  std::string refused; // why it is not measured there; empty: it is
  LeanSame same = LeanSame::State;
  Comparison time;
  std::size_t bytes_off = 0, bytes_on = 0; // of all arrays (footprint.h)
  bool same_state = false, same_pixels = false;

  bool measured() const { return refused.empty(); }
  bool as_promised() const; // the same, where it must be
};

struct LeanPlan {
  std::vector<LeanScene> scenes;
  std::vector<Override> overrides; // of all of them
  int builds = 9;                  // of both sides
  int pairs = 4;                   // of runs, of each build
  double seconds = 0.02;           // of each run
};

// One row for each feature on each scene. Throws UserError where a scene cannot be built as it is; Interrupted.
std::vector<LeanRow> run_lean(const LeanPlan& plan, const StudyCalls& calls);

} // namespace rend
