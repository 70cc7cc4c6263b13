// Rates of change of expressions, against central differences of their values: every function and operator, and
// the places where there is no derivative.
#include "sim/expression/rates.h"

#include "sim/expression/functions.h"
#include "sim/expression/noise.h"
#include "sim/expression/operators.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>

namespace rend::rates_test {
namespace {

constexpr ValueType S = ValueType::Scalar, V = ValueType::Vector;

const std::vector<ExpressionFunction>& variables() {
  static const std::vector<ExpressionFunction> all{{"r", {}, S, ""}, {"s", {}, S, ""}, {"t", {}, S, ""},
                                                   {"u", {}, V, ""}, {"v", {}, V, ""}, {"zero", {}, S, ""}};
  return all;
}

// Curves whose values and rates are written down.
ValueAndRate at_time(const std::string& name, double time) {
  if (name == "r") return {scalar_value(0.7 + 0.3 * std::sin(time)), scalar_value(0.3 * std::cos(time))};
  if (name == "s") return {scalar_value(0.4 + 0.2 * time), scalar_value(0.2)};
  if (name == "t") return {scalar_value(1.3 - 0.1 * time * time), scalar_value(-0.2 * time)};
  if (name == "u") return {vector_value(0.3 + time, 1 - 0.5 * time, 0.2), vector_value(1, -0.5, 0)};
  if (name == "v") return {vector_value(time * time, -0.4, 2 - time), vector_value(2 * time, 0, -1)};
  return {scalar_value(0), scalar_value(0)};
}

Value value_at(const Expression& expression, double time) {
  return expression.evaluate([&](const ExpressionCall& call, std::size_t, std::span<const Value>) {
    return at_time(call.name, time).value;
  });
}

ValueAndRate moving_at(const Expression& expression, double time) {
  return expression.evaluate_with_rate([&](const ExpressionCall& call, std::size_t, std::span<const Value>,
                                           std::span<const Value>) { return at_time(call.name, time); });
}

void expect_rate(const std::string& text, ValueType type, double time) {
  SCOPED_TRACE(fmt::format("{} at {}", text, time));
  constexpr double h = 1e-5;
  const Expression expression(text, variables(), type);
  const ValueAndRate found = moving_at(expression, time);
  const Value before = value_at(expression, time - h), after = value_at(expression, time + h);
  for (std::size_t n = 0; n < 3; ++n) {
    const double expected = (after.number[n] - before.number[n]) / (2 * h);
    EXPECT_NEAR(found.rate.number[n], expected, 1e-7 * (1 + std::abs(expected)));
    EXPECT_EQ(found.value.number[n], value_at(expression, time).number[n]);
  }
}

// Its arguments are curves that keep away from edges.
TEST(Rates, of_every_function_are_its_derivative) {
  const std::vector<std::string> scalars{"r", "s", "t"}, vectors{"u", "v"};
  for (const BuiltIn& each : built_ins()) {
    std::string arguments;
    std::size_t of_scalars = 0, of_vectors = 0;
    for (ValueType type : each.declared.arguments)
      arguments +=
          (arguments.empty() ? "" : ", ") + (type == S ? scalars.at(of_scalars++) : vectors.at(of_vectors++));
    if (each.declared.name == "noise") arguments = "3*u + v, 7";
    const std::string text = each.declared.name + (arguments.empty() ? "" : "(" + arguments + ")");
    for (double time : {0.1, 0.35, 0.8}) expect_rate(text, each.declared.result, time);
  }
}

TEST(Rates, of_every_operator_are_its_derivative) {
  std::size_t checked = 0;
  for (const ExpressionOperator& each : operators()) {
    if (each.result == ValueType::Condition) {
      EXPECT_EQ(each.rate, nullptr) << each.symbol;
      continue;
    }
    const auto operand = [&](std::size_t n) {
      return each.operands[n] == S ? n == 0 ? "r" : "t" : n == 0 ? "u" : "v";
    };
    const std::string text = each.operands.size() == 1
                                 ? fmt::format("{}{}", each.symbol, operand(0))
                                 : fmt::format("{} {} {}", operand(0), each.symbol, operand(1));
    for (double time : {0.1, 0.35, 0.8}) expect_rate(text, each.result, time);
    ++checked;
  }
  EXPECT_EQ(checked, 12u);
}

TEST(Rates, go_through_expressions_of_many) {
  for (const char* text :
       {"sin(r*s)^2 / (1 + exp(-t))", "norm(cross(u, v)) - dot(u, v)^3", "min(r, s) + max(r, 5*t)",
        "clamp(3*r, s, t)", "clamp(r, 2*t, 3*t)", "x(u)*y(v) + pow(s, 2)", "noise(u/s)*t",
        "sqrt(dot(v, v) + 1) * abs(-t)", "log(t)*tan(s)"})
    for (double time : {-0.2, 0.1, 0.9}) expect_rate(text, S, time);
  for (const char* text : {"u*(r/s) + v/t", "cross(u, v)/norm(v)", "point(sin(r), s*t, noise(v))"})
    for (double time : {-0.2, 0.1, 0.9}) expect_rate(text, V, time);
}

TEST(Rates, are_defined_where_there_is_no_derivative) {
  const auto rate = [](const char* text) {
    return moving_at(Expression(text, variables(), S), 0.5).rate.scalar();
  };
  EXPECT_EQ(rate("abs(s - 0.5)"), 0);  // |x| at 0
  EXPECT_EQ(rate("norm(u*zero)"), 0);  // of a vector that stays 0
  EXPECT_EQ(rate("sqrt(zero)"), 0);    // its derivative is infinite, and its argument does not change
  EXPECT_EQ(rate("zero^s"), 0);        // 0^y is 0 for all y > 0
  EXPECT_EQ(rate("(s - 0.5)^1"), 0.2); // 0^0 is 1
  EXPECT_EQ(rate("floor(3*s) + step(0.5, s)"), 0);
  EXPECT_EQ(rate("min(s, s + 0) - s"), 0);
}

TEST(Rates, that_are_infinite_are_refused) {
  const auto flaw = [](const char* text) -> std::string {
    try {
      moving_at(Expression(text, variables(), S), 0.5);
    } catch (const ExpressionError& error) {
      return error.flaw;
    }
    return {};
  };
  EXPECT_EQ(flaw("sqrt(s - 0.5)"), "sqrt(0) changes at no finite rate");
  EXPECT_EQ(flaw("1/(s - 0.5)"), "1 / 0 is not a finite number");
}

} // namespace
} // namespace rend::rates_test
