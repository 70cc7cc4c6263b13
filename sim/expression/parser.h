// From the text of an expression to its postfix code; types are checked on the way.
#pragma once

#include "sim/expression/expression.h"

#include <string_view>
#include <vector>

namespace rend {

struct ParsedExpression {
  std::vector<Instruction> program;
  std::vector<ExpressionCall> calls;
  ValueType type = ValueType::Scalar;
};

// Throws ExpressionError; does not evaluate anything.
ParsedExpression parse_expression(std::string_view text, const std::vector<ExpressionFunction>& vocabulary);

// "scalar", "vector", "condition", "name"; and "a scalar" ...
std::string_view type_word(ValueType type);
std::string a_value(ValueType type);

} // namespace rend
