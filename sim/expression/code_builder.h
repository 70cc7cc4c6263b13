// The postfix code of an expression, made one instruction after another: it finds the operator for the types of
// its operands, and knows how many values wait on the stack.
#pragma once

#include "sim/expression/operators.h"
#include "sim/expression/parser.h"
#include "sim/expression/tokens.h"

#include <vector>

namespace rend {

// As instructions have it.
inline std::uint32_t column_of(const ExpressionToken& token) {
  return static_cast<std::uint32_t>(token.column);
}

class CodeBuilder {
public:
  // ExpressionError: more values wait than the stack holds.
  void emit(const Instruction& instruction);
  // ExpressionError: no operator of that symbol takes such operands.
  ValueType emit_operator(const ExpressionToken& symbol, const std::vector<ValueType>& operands);
  // Of a function of the caller. Its names are no values on the stack.
  void emit_call(ExpressionCall call);

  // `and`, `or`: left Skip right Join. The number of the Skip.
  std::size_t emit_skip(const ExpressionToken& symbol);
  void emit_join(const ExpressionToken& symbol, std::size_t skip, const std::vector<ValueType>& operands);

  // Of `if`; leads nowhere yet. It takes a value from the stack: the condition, or, of two that wait for one
  // place, the first.
  std::size_t emit_jump(Instruction::Kind kind, const ExpressionToken& name);
  void lead(std::size_t jump, std::size_t to) { out_.program[jump].index = static_cast<std::uint32_t>(to); }

  std::size_t size() const { return out_.program.size(); }
  ParsedExpression take(ValueType type);

private:
  int values_ = 0;
  ParsedExpression out_;
};

} // namespace rend
