// `rend help rule`: how rules are written, on one page of at most 100 lines of 100 columns.
#pragma once

#include <string>

namespace rend {

std::string rule_page();

// The examples at its end: a file of rules.
std::string rule_examples();

} // namespace rend
