// Compares the run times of two alternatives.
//
// Other load on a machine changes within seconds, and would be mistaken for a difference. So short runs of both
// are made alternately, each first in turn, and the ratio of the two runs of a pair is used. The addresses of
// arrays make a difference of one or two per cent, which no number of runs with the same arrays averages out:
// both are rebuilt several times. The result is the median over builds of the median over pairs, with a
// standard error of about 1.25 · 0.74 · IQR/√n (if the ratios are normally distributed; Kendall & Stuart). A
// difference of less than twice that is noise.
#pragma once

#include "sim/study/study.h"

namespace rend {

// Of one build: [s] per step, one entry per pair.
struct TimedPairs {
  std::vector<double> off, on;
  long steps = 0; // per run
};

// `off` and `on` make one step each. `seconds`: approximate duration of one run.
TimedPairs time_pairs(const std::function<void()>& off, const std::function<void()>& on, int pairs,
                      double seconds);

struct Comparison {
  RunTime off, on;          // [s], per step, over all pairs
  double ratio = 1;         // on / off
  double low = 1, high = 1; // quartiles, over all pairs
  double noise = 0;         // two standard errors of the ratio
  int builds = 0;
  bool differs() const { return ratio < 1 - noise || ratio > 1 + noise; }
};
Comparison comparison_of(const std::vector<TimedPairs>& builds); // at least one (CHECK)

} // namespace rend
