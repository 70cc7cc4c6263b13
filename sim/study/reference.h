// What the runs of a study are compared with, and how far it can be trusted.
//
// The scene is run by rk4 at an eighth of its largest stable step, at a quarter of that, and so on down to an
// eighth of the smallest step that it is studied at, until what is left is round-off or no longer gets smaller;
// and by a second scheme, which shares neither coefficients nor steps with it: rk45 at a tolerance of 1e-13.
// How far the two are apart is the reference's error bar.
#pragma once

#include "sim/study/runs.h"

namespace rend {

struct Reference {
  Trajectory trajectory;
  StudyReference figures;
};

// Throws UserError (Unstable) where no scheme gets through the stretch.
Reference make_reference(const MakeScene& make, const StudyGroup& group, double duration, int steps,
                         const StudyCalls& calls);

} // namespace rend
