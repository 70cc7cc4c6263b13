// The least part of an element of the start (start_element.h) that a cut leaves. Small parts follow the plane
// of the cut closely, and shorten the step.
#pragma once

#include <algorithm>

namespace rend {

struct LeastPart {
  double size = 1.0 / 20; // of the size of the element of the start
  double sine = 1.0 / 4;  // of that of its least angle

  // With a share of the size, up to 0.2. The sine goes with it, since thin parts shorten the step as small ones
  // do: four times that share, a quarter at least.
  static LeastPart of_size(double share) { return {share, std::max(1.0 / 4, 4 * share)}; }
};

} // namespace rend
