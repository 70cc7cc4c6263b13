// Single runs of a study: one that is sampled, and others that are only timed.
#pragma once

#include "sim/study/study.h"

namespace rend {

struct SampledRun {
  Outcome outcome = Outcome::Done;
  std::string reason; // of a failure
  long steps_done = 0;
  double seconds = 0; // of this thread, including sampling
  RunCounts counts;
  Trajectory trajectory; // up to the failure
};

// Makes `steps` steps, with a sample at the start and after each of study_samples equal parts of them.
SampledRun sampled_run(Scene& scene, long steps, const std::function<bool()>& going);

// Seconds of the time loop alone, for a run that is known not to fail.
double timed_run(Scene& scene, long steps, const std::function<bool()>& going);

RunTime summary_of(std::vector<double> seconds); // at least one (CHECK)

double thread_seconds(); // [s], CPU time of this thread

} // namespace rend
