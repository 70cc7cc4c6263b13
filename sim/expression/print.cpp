// Expression::print: from postfix code back to text.
#include "sim/expression/expression.h"
#include "sim/expression/functions.h"
#include "sim/expression/operators.h"

#include <fmt/format.h>

namespace rend {
namespace {

struct Piece {
  std::string text;
  Precedence precedence;
};

Precedence above(Precedence precedence) {
  return static_cast<Precedence>(static_cast<int>(precedence) + 1);
}

// In parentheses where it binds less tightly than `least`.
std::string at_least(Precedence least, const Piece& piece) {
  return piece.precedence < least ? "(" + piece.text + ")" : piece.text;
}

Piece unary(const ExpressionOperator& one, const Piece& operand) {
  const std::string space = one.symbol == "not" ? " " : "";
  return {std::string(one.symbol) + space + at_least(one.precedence, operand), one.precedence};
}

// Equal precedences go from left to right, except those of powers; a sign may stand behind '^'.
Piece binary(const ExpressionOperator& one, const Piece& left, const Piece& right) {
  const bool power = one.precedence == Precedence::Power, tight = one.precedence >= Precedence::Product;
  const std::string symbol = tight ? std::string(one.symbol) : fmt::format(" {} ", one.symbol);
  const Precedence least_left =
      power || one.precedence == Precedence::Comparison ? above(one.precedence) : one.precedence;
  const Precedence least_right = power ? Precedence::Sign : above(one.precedence);
  return {at_least(least_left, left) + symbol + at_least(least_right, right), one.precedence};
}

std::string listed_in_parentheses(const std::vector<std::string>& arguments) {
  std::string out;
  for (const std::string& one : arguments) out += (out.empty() ? "" : ", ") + one;
  return "(" + out + ")";
}

class Printer {
public:
  Printer(const std::vector<Instruction>& program, const std::vector<ExpressionCall>& calls) {
    for (const Instruction& instruction : program) add(instruction, calls);
  }
  const std::string& text() const { return stack_.back().text; }

private:
  void add(const Instruction& instruction, const std::vector<ExpressionCall>& calls) {
    switch (instruction.kind) {
    case Instruction::Kind::Number:
      stack_.push_back({fmt::format("{}", instruction.number), Precedence::Operand});
      return;
    case Instruction::Kind::Skip:
    case Instruction::Kind::Branch:
    case Instruction::Kind::Jump:
      return;
    case Instruction::Kind::Choice: {
      const std::vector<Piece> parts = take(3);
      stack_.push_back(
          {fmt::format("if({}, {}, {})", parts[0].text, parts[1].text, parts[2].text), Precedence::Operand});
      return;
    }
    case Instruction::Kind::Join:
    case Instruction::Kind::Operator:
      add_operator(operators()[instruction.index]);
      return;
    case Instruction::Kind::Function:
      add_function(built_ins()[instruction.index].declared, instruction.count);
      return;
    case Instruction::Kind::Call:
      add_call(calls[instruction.index], instruction.count);
      return;
    }
  }

  void add_operator(const ExpressionOperator& one) {
    const std::vector<Piece> operands = take(one.operands.size());
    stack_.push_back(operands.size() == 1 ? unary(one, operands[0]) : binary(one, operands[0], operands[1]));
  }

  void add_function(const ExpressionFunction& one, std::size_t count) {
    std::vector<std::string> arguments;
    for (const Piece& piece : take(count)) arguments.push_back(piece.text);
    stack_.push_back(
        {one.name + (one.arguments.empty() ? "" : listed_in_parentheses(arguments)), Precedence::Operand});
  }

  void add_call(const ExpressionCall& call, std::size_t count) {
    const std::vector<Piece> values = take(count);
    std::vector<std::string> arguments;
    auto value = values.begin();
    auto name = call.names.begin();
    for (const ValueType type : call.arguments)
      arguments.push_back(type == ValueType::Name ? *name++ : (value++)->text);
    stack_.push_back(
        {call.name + (call.variable ? "" : listed_in_parentheses(arguments)), Precedence::Operand});
  }

  // The last `count` pieces, in order.
  std::vector<Piece> take(std::size_t count) {
    std::vector<Piece> out(std::make_move_iterator(stack_.end() - count),
                           std::make_move_iterator(stack_.end()));
    stack_.resize(stack_.size() - count);
    return out;
  }

  std::vector<Piece> stack_;
};

} // namespace

std::string Expression::print() const {
  const std::string out = Printer(program_, calls_).text();
  return out.size() <= longest_expression ? out : text_;
}

} // namespace rend
