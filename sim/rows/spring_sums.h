// The spring kernel with bounds, for criteria on single forces.
//
// The fourth lane of a force record is unused: the same pass accumulates there the magnitudes of the spring
// forces on the vertex, parallel springs each by itself, k|l − l0| + λ|u·w|. The caller clears the lane before
// others read the forces.
#pragma once

#include "sim/rows/kernels.h"

namespace rend {

void spring_forces_with_sums(const KernelArguments& a); // only for spring_law()

} // namespace rend
