// An expression that a user wrote, such as lerp(a, b, 0.5) or size(a, face) > 3: checked and compiled once,
// then evaluated often.
//
//   or                    condition or condition       lowest precedence
//   and                   condition and condition
//   not                   not condition
//   < <= > >= == !=       scalar < scalar              not chained: a < b and b < c
//   + -                   of two scalars or two vectors
//   * /                   scalar * scalar, scalar * vector, vector * scalar; scalar / scalar, vector / scalar
//   -                     -2^2 is -4
//   ^                     scalar ^ scalar; 2^3^2 is 2^(3^2), 2^-1 is 0.5
//   if(condition, u, v)   u where the condition holds, else v: two values of one type
//
// with numbers (1, 0.5, 1e-4), parentheses, the functions of sim/expression/functions.h and those of the
// caller. What follows `and` and `or`, and the two values of `if`, are evaluated only where they decide: n > 0
// and 1/n < 0.1 is fine for n = 0, and so is if(n > 0, 1/n, 0).
//
// Text of users is hostile: its length and depth are bounded before it is parsed, and every refusal is a
// sentence with its column. A value that is not finite is refused where it arises, even inside an expression
// whose result would be finite. Evaluation gives the same bits on every processor (sim/base/math.h). muParser
// was considered: it knows no vectors, and its functions are those of the C library.
#pragma once

#include "sim/expression/program.h"
#include "sim/expression/value.h"

#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace rend {

constexpr std::size_t longest_expression = 4000; // bytes
constexpr int deepest_expression = 50; // parentheses, calls, signs, `not` and powers within each other

// What is wrong with an expression; what() is "column 5: there is no function 'lenght'".
struct ExpressionError : std::runtime_error {
  ExpressionError(std::size_t column, const std::string& flaw, const std::string& hint = {});
  std::size_t column; // in the text of the expression, from 1
  std::string flaw;   // a sentence, without the column
  std::string hint;   // what would work, such as "did you mean 'length'?"; may be empty
};

// A function or, without arguments, a variable that the caller supplies. Its name is a word: a letter or _,
// then letters, digits and _; neither that of a built-in function nor `and`, `or`, `not`, `if`.
struct ExpressionFunction {
  std::string name;
  std::vector<ValueType> arguments;
  ValueType result = ValueType::Scalar; // not Name
  std::string about;                    // one line of help
  std::size_t optional = 0;             // how many arguments at the end may be left out
  // A call of it, with a name and a whole number, may stand where a name is expected: alpha(a, 2). Its only
  // name is then the call itself, in a normal form.
  bool is_name = false;
};

// "lerp(name, name, scalar)", "noise(vector[, scalar])", "time".
std::string signature(const ExpressionFunction& function);

// A call of such a function in an expression. A word that occurs twice is two calls.
struct ExpressionCall {
  std::size_t function = 0; // in the vocabulary
  std::string name;         // of the function
  std::size_t column = 0;   // of the name in the text, from 1
  ValueType result = ValueType::Scalar;
  std::vector<ValueType> arguments; // types of those that are there
  std::vector<std::string> names;   // its arguments of type Name, in order
  std::vector<std::size_t> columns; // of the names, from 1
  bool variable = false;            // written without parentheses
};

class Expression {
public:
  // Throws ExpressionError: what is not an expression of type `wanted` (nullopt: of any), and a constant one
  // that has no finite value. The vocabulary is needed only here. A flaw in it is a bug of the caller (CHECK).
  Expression(std::string_view text, const std::vector<ExpressionFunction>& vocabulary,
             std::optional<ValueType> wanted);

  const std::string& text() const { return text_; }
  ValueType type() const { return type_; }
  // In the order in which they stand in the text, inner ones before outer ones.
  const std::vector<ExpressionCall>& calls() const { return calls_; }
  // Calls nothing of the caller.
  bool constant() const { return calls_.empty(); }

  // A normal form, which parses to the same expression: numbers as short as they can be, no blanks and
  // parentheses but those needed or usual. Where it would exceed the greatest length, the text itself.
  std::string print() const;

  // The value. supply(call, number, arguments) → Value gives that of calls()[number], whose arguments that are
  // not names are evaluated, in order: Value(const ExpressionCall&, std::size_t, std::span<const Value>).
  // Allocates nothing. Throws ExpressionError where a value is not finite, and what `supply` throws.
  template <class Supply> Value evaluate(Supply&& supply) const;
  Value evaluate() const; // of a constant one

  // The same, with the rate at which the value changes where those of the calls do (rates.h): exact, by the
  // chain rule (forward differentiation; Griewank and Walther, Evaluating Derivatives, 2008, chapter 3).
  // `supply` gets the rates of the arguments as well, and returns a ValueAndRate. Throws ExpressionError where
  // a rate is not finite.
  template <class Supply> ValueAndRate evaluate_with_rate(Supply&& supply) const;

private:
  // `rates`: of the arguments; null: rates are not asked for, and that of the result is not looked at.
  using Forward = ValueAndRate (*)(void*, const ExpressionCall&, std::size_t, std::span<const Value>,
                                   const Value* rates);
  ValueAndRate run(Forward forward, void* supply, bool with_rate) const;
  [[noreturn]] void refuse(const Instruction& instruction, const Value* arguments, const char* fault) const;

  std::string text_;
  ValueType type_;
  std::vector<Instruction> program_; // postfix
  std::vector<ExpressionCall> calls_;
};

template <class Supply> Value Expression::evaluate(Supply&& supply) const {
  using Object = std::remove_reference_t<Supply>;
  const Forward forward = [](void* object, const ExpressionCall& call, std::size_t number,
                             std::span<const Value> arguments, const Value*) -> ValueAndRate {
    return {(*static_cast<Object*>(object))(call, number, arguments), {}};
  };
  return run(forward, const_cast<std::remove_const_t<Object>*>(&supply), false).value;
}

template <class Supply> ValueAndRate Expression::evaluate_with_rate(Supply&& supply) const {
  using Object = std::remove_reference_t<Supply>;
  const Forward forward = [](void* object, const ExpressionCall& call, std::size_t number,
                             std::span<const Value> arguments, const Value* rates) -> ValueAndRate {
    return (*static_cast<Object*>(object))(call, number, arguments, std::span(rates, arguments.size()));
  };
  return run(forward, const_cast<std::remove_const_t<Object>*>(&supply), true);
}

} // namespace rend
