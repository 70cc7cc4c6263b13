// The spring kernel with bounds, for criteria that look at single forces.
//
// The fourth lane of a force record is free: there the same pass adds up the sizes of what springs put on the
// vertex, of parallel ones each by itself, k|l − l0| + λ|u·w|. Whoever asks for it clears the lane before
// others read the forces.
#pragma once

#include "sim/rows/kernels.h"

namespace rend {

void spring_forces_with_sums(const KernelArguments& a); // laws: spring_law() alone

} // namespace rend
