// The families of cases, one file each (family_*.cpp).
#pragma once

#include "sim/check/case.h"

namespace rend {

CheckFamily stiffness_family();
CheckFamily poisson_family();
CheckFamily step_limit_family();

} // namespace rend
