// How much of a clip a study runs: long enough to distinguish schemes, short enough to be run hundreds of
// times.
//
//   without tears   0.2 s, or 64 of symplectic's largest steps if that is more
//   with tears      1.25 times the time of the preset's first tear; if it does not tear, as above
//   with answers    extended to the last <answer> that is due within ten times that
//
// and never more than the clip.
#pragma once

#include "sim/study/study.h"

namespace rend {

struct StudyDuration {
  double seconds = 0; // simulated
  std::string why;
};
StudyDuration study_duration(const MakeScene& make, const std::vector<Setting>& settings,
                             const StudyCalls& calls);

} // namespace rend
