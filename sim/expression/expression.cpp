#include "sim/expression/expression.h"

#include "sim/base/check.h"
#include "sim/expression/functions.h"
#include "sim/expression/operators.h"
#include "sim/expression/parser.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace rend {
namespace {

// A word that is neither a keyword nor a built-in function.
bool may_name(std::string_view name) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  return !name.empty() && letter(name[0]) && name != "and" && name != "or" && name != "not" && name != "if" &&
         std::ranges::all_of(name, [&](char c) { return letter(c) || (c >= '0' && c <= '9'); }) &&
         std::ranges::none_of(built_ins(), [&](const BuiltIn& one) { return one.declared.name == name; });
}

void check_vocabulary(const std::vector<ExpressionFunction>& vocabulary) {
  std::vector<std::string_view> names;
  for (const ExpressionFunction& one : vocabulary) {
    CHECK_NOTE(may_name(one.name), one.name);
    CHECK_NOTE(one.optional <= one.arguments.size() && one.arguments.size() <= 100, one.name);
    CHECK_NOTE(one.result != ValueType::Name, one.name);
    names.push_back(one.name);
  }
  std::ranges::sort(names);
  const auto twice = std::ranges::adjacent_find(names);
  CHECK_NOTE(twice == names.end(), std::string(*twice));
}

bool is_finite(const Value& value) {
  return std::isfinite(value.number[0]) && std::isfinite(value.number[1]) && std::isfinite(value.number[2]);
}

Rate rate_of(const Instruction& instruction) {
  return instruction.kind == Instruction::Kind::Operator ? operators()[instruction.index].rate
                                                         : built_ins()[instruction.index].rate;
}

// "0.5", "(1, 2, 3)"
std::string shown(const Value& value, ValueType type) {
  const auto& n = value.number;
  if (type == ValueType::Condition) return value.condition() ? "true" : "false";
  return type == ValueType::Scalar ? fmt::format("{}", n[0]) : fmt::format("({}, {}, {})", n[0], n[1], n[2]);
}

} // namespace

ExpressionError::ExpressionError(std::size_t column_, const std::string& flaw_, const std::string& hint_)
    : std::runtime_error(fmt::format("column {}: {}", column_, flaw_)), column(column_), flaw(flaw_),
      hint(hint_) {}

std::string signature(const ExpressionFunction& function) {
  if (function.arguments.empty()) return function.name;
  const std::size_t least = function.arguments.size() - function.optional;
  std::string out = function.name + "(";
  for (std::size_t n = 0; n < function.arguments.size(); ++n) {
    if (n >= least) out += '[';
    if (n > 0) out += ", ";
    out += type_word(function.arguments[n]);
  }
  return out + std::string(function.optional, ']') + ")";
}

Expression::Expression(std::string_view text, const std::vector<ExpressionFunction>& vocabulary,
                       std::optional<ValueType> wanted) {
  CHECK(wanted != ValueType::Name);
  check_vocabulary(vocabulary);
  ParsedExpression parsed = parse_expression(text, vocabulary);
  type_ = parsed.type;
  if (wanted && type_ != *wanted)
    throw ExpressionError(
        1, fmt::format("the expression is {}, where {} is wanted", a_value(type_), a_value(*wanted)),
        wanted == ValueType::Vector      ? "a vector is point(x, y, z)"
        : wanted == ValueType::Condition ? "a condition is a comparison, such as x > 0"
                                         : "");
  text_ = text;
  program_ = std::move(parsed.program);
  calls_ = std::move(parsed.calls);
  if (constant()) evaluate();
}

Value Expression::evaluate() const {
  CHECK(constant());
  return run(nullptr, nullptr, false).value;
}

ValueAndRate Expression::run(Forward forward, void* supply, bool with_rate) const {
  std::array<Value, most_values> values, rates; // not initialised: the parser has counted what is used
  std::size_t top = 0;                          // behind the last value
  for (std::size_t n = 0; n < program_.size(); ++n) {
    const Instruction& instruction = program_[n];
    const std::size_t first = top - instruction.count;
    const Value* const arguments = values.data() + first;
    ValueAndRate made{};
    switch (instruction.kind) {
    case Instruction::Kind::Number:
      values[top] = scalar_value(instruction.number);
      rates[top++] = scalar_value(0);
      continue;
    case Instruction::Kind::Skip:
      if (values[top - 1].condition() == instruction.when)
        n = instruction.index;
      else
        --top;
      continue;
    case Instruction::Kind::Branch:
      if (!values[--top].condition()) n = instruction.index;
      continue;
    case Instruction::Kind::Jump:
      n = instruction.index;
      continue;
    case Instruction::Kind::Join:
    case Instruction::Kind::Choice:
      continue;
    case Instruction::Kind::Operator:
    case Instruction::Kind::Function:
      made.value = instruction.apply(arguments, instruction.count);
      if (const Rate rate = with_rate ? rate_of(instruction) : nullptr)
        made.rate = rate(arguments, rates.data() + first, instruction.count);
      break;
    case Instruction::Kind::Call:
      made = forward(supply, calls_[instruction.index], instruction.index, {arguments, instruction.count},
                     with_rate ? rates.data() + first : nullptr);
      break;
    }
    if (!is_finite(made.value)) refuse(instruction, arguments, "is not a finite number");
    if (with_rate && !is_finite(made.rate)) refuse(instruction, arguments, "changes at no finite rate");
    values[first] = made.value;
    rates[first] = made.rate;
    top = first + 1;
  }
  return {values[0], rates[0]};
}

void Expression::refuse(const Instruction& instruction, const Value* arguments, const char* fault) const {
  std::string what;
  if (instruction.kind == Instruction::Kind::Operator) {
    const ExpressionOperator& one = operators()[instruction.index];
    const auto operand = [&](std::size_t n) {
      const bool negative = one.operands[n] == ValueType::Scalar && arguments[n].scalar() < 0;
      const std::string text = shown(arguments[n], one.operands[n]);
      return negative ? "(" + text + ")" : text;
    };
    what = one.operands.size() == 1 ? std::string(one.symbol) + operand(0)
                                    : fmt::format("{} {} {}", operand(0), one.symbol, operand(1));
  } else if (instruction.kind == Instruction::Kind::Function) {
    const ExpressionFunction& one = built_ins()[instruction.index].declared;
    for (std::size_t n = 0; n < instruction.count; ++n)
      what += (n == 0 ? "" : ", ") + shown(arguments[n], one.arguments[n]);
    what = fmt::format("{}({})", one.name, what);
  } else {
    what = fmt::format("the value of '{}'", calls_[instruction.index].name);
  }
  throw ExpressionError(instruction.column, fmt::format("{} {}", what, fault));
}

} // namespace rend
