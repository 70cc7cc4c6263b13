// Compiles the graphs of a rule into the steps of a match and of the rewriting.
#pragma once

#include "sim/rules/rule.h"

namespace rend {

// `before`: see Rule. The graphs are checked (rule_check.h).
RulePlan make_plan(const RuleGraph& left, const RuleGraph& right, const std::vector<int>& before,
                   const std::vector<int>& after);

} // namespace rend
