// Two ways of doing the same, timed against each other.
//
// What else a machine does changes within seconds, and would be taken for a difference. So short runs of both are made
// in turn, now the one first and now the other, and what counts is the ratio of the two of a pair: its median, and the
// quartiles between which half of the pairs lie. The median of n pairs is known to about 1.25 · 0.74 · IQR/√n (its
// standard error where the ratios are normally spread; Kendall & Stuart), so that a difference of less than twice that is
// noise.
#pragma once

#include "sim/study/study.h"

namespace rend {

struct Comparison {
  RunTime off, on;          // [s], of a step
  double ratio = 1;         // on / off: the median over pairs
  double low = 1, high = 1; // its quartiles
  double noise = 0;         // two standard errors of the median
  int pairs = 0;
  long steps = 0; // of each run
  bool differs() const { return ratio < 1 - noise || ratio > 1 + noise; }
};

// `off` and `on` make one step each. `seconds`: about how long one run takes.
Comparison compare_times(const std::function<void()>& off, const std::function<void()>& on, int pairs,
                         double seconds);

} // namespace rend
