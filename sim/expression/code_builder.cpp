#include "sim/expression/code_builder.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {
namespace {

std::uint32_t number_of(const ExpressionOperator& one) {
  return static_cast<std::uint32_t>(&one - operators().data());
}

const ExpressionOperator& operator_for(const ExpressionToken& symbol, const std::vector<ValueType>& operands) {
  const ExpressionOperator* found = find_operator(symbol.text, operands);
  if (found) return *found;
  std::string given = a_value(operands[0]);
  if (operands.size() == 2)
    given = operands[0] == operands[1] ? fmt::format("two {}s", type_word(operands[0]))
                                       : given + " and " + a_value(operands[1]);
  throw ExpressionError(
      symbol.column,
      fmt::format("'{}' takes {}, here {}", symbol.text, taken_by(symbol.text, operands.size()), given),
      std::string(operand_hint(symbol.text, operands)));
}

} // namespace

void CodeBuilder::emit(const Instruction& instruction) {
  const bool pushes =
      instruction.kind != Instruction::Kind::Skip && instruction.kind != Instruction::Kind::Join;
  values_ += (pushes ? 1 : 0) - instruction.count;
  if (values_ > static_cast<int>(most_values))
    throw ExpressionError(instruction.column,
                          fmt::format("more than {} values wait for an operator here", most_values));
  out_.program.push_back(instruction);
}

ValueType CodeBuilder::emit_operator(const ExpressionToken& symbol, const std::vector<ValueType>& operands) {
  const ExpressionOperator& found = operator_for(symbol, operands);
  emit({.kind = Instruction::Kind::Operator,
        .result = found.result,
        .count = static_cast<std::uint8_t>(operands.size()),
        .index = number_of(found),
        .column = column_of(symbol),
        .apply = found.apply});
  return found.result;
}

void CodeBuilder::emit_call(ExpressionCall call) {
  const auto names = std::count(call.arguments.begin(), call.arguments.end(), ValueType::Name);
  emit({.kind = Instruction::Kind::Call,
        .result = call.result,
        .count = static_cast<std::uint8_t>(static_cast<std::ptrdiff_t>(call.arguments.size()) - names),
        .index = static_cast<std::uint32_t>(out_.calls.size()),
        .column = static_cast<std::uint32_t>(call.column)});
  out_.calls.push_back(std::move(call));
}

std::size_t CodeBuilder::emit_skip(const ExpressionToken& symbol) {
  emit({.kind = Instruction::Kind::Skip,
        .when = symbol.text == "or",
        .result = ValueType::Condition,
        .count = 1,
        .column = column_of(symbol)});
  return size() - 1;
}

void CodeBuilder::emit_join(const ExpressionToken& symbol, std::size_t skip,
                            const std::vector<ValueType>& operands) {
  const ExpressionOperator& found = operator_for(symbol, operands);
  lead(skip, size());
  emit({.kind = Instruction::Kind::Join,
        .result = ValueType::Condition,
        .index = number_of(found),
        .column = column_of(symbol)});
}

std::size_t CodeBuilder::emit_jump(Instruction::Kind kind, const ExpressionToken& name) {
  --values_;
  out_.program.push_back({.kind = kind, .column = column_of(name)});
  return size() - 1;
}

ParsedExpression CodeBuilder::take(ValueType type) {
  out_.type = type;
  return std::move(out_);
}

} // namespace rend
