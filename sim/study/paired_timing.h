// Two ways of doing the same, timed against each other.
//
// What else a machine does changes within seconds, and would be taken for a difference. So short runs of both
// are made in turn, now the one first and now the other, and what counts is the ratio of the two of a pair.
// Where arrays happen to lie in memory makes a difference of one or two per cent, which no number of runs of
// the same arrays averages out: both are built anew several times. Of each build the median of its pairs
// counts; of the builds the median again, known to about 1.25 · 0.74 · IQR/√n (its standard error where the
// ratios are normally spread; Kendall & Stuart). A difference of less than twice that is noise.
#pragma once

#include "sim/study/study.h"

namespace rend {

// Of one build. [s] a step, one of each per pair.
struct TimedPairs {
  std::vector<double> off, on;
  long steps = 0; // of each run
};

// `off` and `on` make one step each. `seconds`: about how long one run takes.
TimedPairs time_pairs(const std::function<void()>& off, const std::function<void()>& on, int pairs,
                      double seconds);

struct Comparison {
  RunTime off, on;          // [s], of a step, over all pairs
  double ratio = 1;         // on / off
  double low = 1, high = 1; // quartiles, over all pairs
  double noise = 0;         // two standard errors of the ratio
  int builds = 0;
  bool differs() const { return ratio < 1 - noise || ratio > 1 + noise; }
};
Comparison comparison_of(const std::vector<TimedPairs>& builds); // at least one (CHECK)

} // namespace rend
