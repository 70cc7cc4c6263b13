// The operators of expressions, one row for each combination of operands that has a meaning.
#pragma once

#include "sim/expression/value.h"

#include <span>
#include <string_view>
#include <vector>

namespace rend {

// From the loosest to the tightest.
enum class Precedence { Or = 1, And, Not, Comparison, Sum, Product, Sign, Power, Operand };

struct ExpressionOperator {
  std::string_view symbol;
  Precedence precedence;
  std::vector<ValueType> operands; // one or two
  ValueType result;
  Apply apply;         // null for `and` and `or`
  Rate rate = nullptr; // null: of conditions
};

const std::vector<ExpressionOperator>& operators();

// The operator of that symbol for those operands, or null.
const ExpressionOperator* find_operator(std::string_view symbol, std::span<const ValueType> operands);

// The precedence of a symbol between two operands; none: Precedence{}.
Precedence binary_precedence(std::string_view symbol);

// What the operator takes, as the end of a sentence: "two scalars or two vectors"; and what may help a user who
// gave it others, or "".
std::string_view taken_by(std::string_view symbol, std::size_t operands);
std::string_view operand_hint(std::string_view symbol, std::span<const ValueType> operands);

} // namespace rend
