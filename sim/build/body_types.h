// The elements of a preset that a body is made of, as the parameter table has them: children of <body>.
#pragma once

#include "sim/base/parameters.h"

namespace rend {

std::vector<ChildType> shape_types();
std::vector<ChildType> matter_types();
std::vector<ChildType> motion_types();
std::vector<ChildType> law_types();
std::vector<ChildType> probe_types();
const ElementType& contact_type();

} // namespace rend
