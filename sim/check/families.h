// The families of cases, one file each (family_*.cpp).
#pragma once

#include "sim/check/case.h"

namespace rend {

CheckFamily stiffness_family();
CheckFamily poisson_family();
CheckFamily mass_family();
CheckFamily step_limit_family();
CheckFamily long_family();
CheckFamily shape_family();
CheckFamily degenerate_family();
CheckFamily speed_family();
CheckFamily size_family();
CheckFamily tear_family();
CheckFamily fault_family();
CheckFamily energy_family();
CheckFamily rest_family();
CheckFamily contact_family();
CheckFamily contact_at_rest_family();

} // namespace rend
