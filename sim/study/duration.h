// How much of a clip a study runs: long enough to tell schemes apart, short enough to be run hundreds of times.
//
//   nothing tears   0.2 s, or 64 of symplectic's largest steps where that is more
//   it tears        a quarter more than the preset itself needs to its first tear; without a tear as above
//   answers         on to the last <answer> that is due within ten times that
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
