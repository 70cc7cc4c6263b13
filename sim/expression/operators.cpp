#include "sim/expression/operators.h"

#include "sim/base/math.h"
#include "sim/expression/rates.h"

#include <algorithm>

namespace rend {
namespace {

constexpr ValueType C = ValueType::Condition;

Value scaled(const Value& v, double by) {
  return vector_value(v.number[0] * by, v.number[1] * by, v.number[2] * by);
}

Value add_vectors(const Value* a, std::size_t) {
  const auto &u = a[0].number, &v = a[1].number;
  return vector_value(u[0] + v[0], u[1] + v[1], u[2] + v[2]);
}
Value subtract_vectors(const Value* a, std::size_t) {
  const auto &u = a[0].number, &v = a[1].number;
  return vector_value(u[0] - v[0], u[1] - v[1], u[2] - v[2]);
}
Value divide_vector(const Value* a, std::size_t) {
  const auto& u = a[0].number;
  const double by = a[1].scalar();
  return vector_value(u[0] / by, u[1] / by, u[2] / by);
}

} // namespace

const std::vector<ExpressionOperator>& operators() {
  using P = Precedence;
  constexpr ValueType S = ValueType::Scalar, V = ValueType::Vector;
  static const std::vector<ExpressionOperator> all = {
      {"or", P::Or, {C, C}, C, nullptr},
      {"and", P::And, {C, C}, C, nullptr},
      {"not", P::Not, {C}, C, [](const Value* a, std::size_t) { return condition_value(!a->condition()); }},
      {"<",
       P::Comparison,
       {S, S},
       C,
       [](const Value* a, std::size_t) { return condition_value(a[0].scalar() < a[1].scalar()); }},
      {"<=",
       P::Comparison,
       {S, S},
       C,
       [](const Value* a, std::size_t) { return condition_value(a[0].scalar() <= a[1].scalar()); }},
      {">",
       P::Comparison,
       {S, S},
       C,
       [](const Value* a, std::size_t) { return condition_value(a[0].scalar() > a[1].scalar()); }},
      {">=",
       P::Comparison,
       {S, S},
       C,
       [](const Value* a, std::size_t) { return condition_value(a[0].scalar() >= a[1].scalar()); }},
      {"==",
       P::Comparison,
       {S, S},
       C,
       [](const Value* a, std::size_t) { return condition_value(a[0].scalar() == a[1].scalar()); }},
      {"!=",
       P::Comparison,
       {S, S},
       C,
       [](const Value* a, std::size_t) { return condition_value(a[0].scalar() != a[1].scalar()); }},
      {"+",
       P::Sum,
       {S, S},
       S,
       [](const Value* a, std::size_t) { return scalar_value(a[0].scalar() + a[1].scalar()); },
       rates::of_sum},
      {"+", P::Sum, {V, V}, V, add_vectors, rates::of_sum},
      {"-",
       P::Sum,
       {S, S},
       S,
       [](const Value* a, std::size_t) { return scalar_value(a[0].scalar() - a[1].scalar()); },
       rates::of_difference},
      {"-", P::Sum, {V, V}, V, subtract_vectors, rates::of_difference},
      {"*",
       P::Product,
       {S, S},
       S,
       [](const Value* a, std::size_t) { return scalar_value(a[0].scalar() * a[1].scalar()); },
       rates::of_product},
      {"*",
       P::Product,
       {S, V},
       V,
       [](const Value* a, std::size_t) { return scaled(a[1], a[0].scalar()); },
       rates::of_scalar_times_vector},
      {"*",
       P::Product,
       {V, S},
       V,
       [](const Value* a, std::size_t) { return scaled(a[0], a[1].scalar()); },
       rates::of_vector_times_scalar},
      {"/",
       P::Product,
       {S, S},
       S,
       [](const Value* a, std::size_t) { return scalar_value(a[0].scalar() / a[1].scalar()); },
       rates::of_quotient},
      {"/", P::Product, {V, S}, V, divide_vector, rates::of_quotient},
      {"-",
       P::Sign,
       {S},
       S,
       [](const Value* a, std::size_t) { return scalar_value(-a->scalar()); },
       rates::of_opposite},
      {"-",
       P::Sign,
       {V},
       V,
       [](const Value* a, std::size_t) { return vector_value(-a->number[0], -a->number[1], -a->number[2]); },
       rates::of_opposite},
      {"^",
       P::Power,
       {S, S},
       S,
       [](const Value* a, std::size_t) { return scalar_value(power(a[0].scalar(), a[1].scalar())); },
       rates::of_power},
  };
  return all;
}

const ExpressionOperator* find_operator(std::string_view symbol, std::span<const ValueType> operands) {
  for (const ExpressionOperator& one : operators())
    if (one.symbol == symbol && std::ranges::equal(one.operands, operands)) return &one;
  return nullptr;
}

Precedence binary_precedence(std::string_view symbol) {
  for (const ExpressionOperator& one : operators())
    if (one.symbol == symbol && one.operands.size() == 2) return one.precedence;
  return Precedence{};
}

std::string_view taken_by(std::string_view symbol, std::size_t operands) {
  if (symbol == "not") return "a condition";
  if (symbol == "and" || symbol == "or") return "two conditions";
  if (symbol == "-" && operands == 1) return "a scalar or a vector";
  if (symbol == "+" || symbol == "-") return "two scalars or two vectors";
  if (symbol == "*") return "two scalars, or a scalar and a vector";
  if (symbol == "/") return "a scalar or a vector, and a scalar to divide it by";
  return "two scalars";
}

std::string_view operand_hint(std::string_view symbol, std::span<const ValueType> operands) {
  const auto has = [&](ValueType type) { return std::ranges::find(operands, type) != operands.end(); };
  if (symbol == "and" || symbol == "or" || symbol == "not") return "a condition is a comparison, such as x > 0";
  if (binary_precedence(symbol) == Precedence::Comparison) {
    if (has(C)) return "comparisons are joined by 'and': a < b and b < c";
    return "vectors are compared by their norm(u), or by x(u), y(u), z(u)";
  }
  if (has(C)) return {};
  if (symbol == "*") return "products of vectors are dot(u, v) and cross(u, v)";
  if (symbol == "^") return "the square of a vector's length is dot(u, u)";
  return {};
}

} // namespace rend
