// The functions that every expression knows, and pi. Another one is another row of built_ins().
//
// Angles are in radians. Nothing here depends on the processor.
#pragma once

#include "sim/expression/expression.h"

#include <vector>

namespace rend {

struct BuiltIn {
  ExpressionFunction declared;
  Apply apply;
  Rate rate = nullptr; // null: its value changes in jumps alone
};

const std::vector<BuiltIn>& built_ins();

} // namespace rend
