// Cases for a user's own preset: is it stable, with what margin, at which step does it fail, and which scheme
// would work.
#pragma once

#include "sim/check/case.h"

namespace rend {

// `name`: prefix of the names of the cases. `path`: the preset; it is read when a case runs.
std::vector<CheckCase> preset_cases(const std::string& name, const std::string& path);

} // namespace rend
