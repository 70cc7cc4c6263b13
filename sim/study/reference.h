// The reference solution of a study, and its error bar.
//
// The scene is run by rk4 at an eighth of its largest stable step, at a quarter of that, and so on down to an
// eighth of the smallest step studied, until the difference is round-off or no longer decreases; and by a
// second scheme, which shares neither coefficients nor steps with it: rk45 at a tolerance of 1e-13. The
// distance of the two is the error bar of the reference.
#pragma once

#include "sim/study/runs.h"

namespace rend {

struct Reference {
  Trajectory trajectory;
  StudyReference figures;
};

// Throws UserError (Unstable) if no scheme completes the duration.
Reference make_reference(const MakeScene& make, const StudyGroup& group, double duration, int steps,
                         const StudyCalls& calls);

} // namespace rend
