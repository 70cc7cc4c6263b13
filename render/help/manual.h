// The manual pages in troff for man(1): rend(1) from the command line's declarations, rend-preset(5) from the
// parameter table. They contain no text of their own that could become outdated.
#pragma once

#include "render/help/usage.h"
#include "sim/base/parameters.h"

#include <string>

namespace rend {

// Lines of man(7) macros, UTF-8. `version` "0.2.0", `date` "2026-11-22" or empty.
std::string manual(const CommandUsage& program, const std::string& version, const std::string& date);
std::string manual_of_presets(const ElementType& root, const std::string& version, const std::string& date);

} // namespace rend
