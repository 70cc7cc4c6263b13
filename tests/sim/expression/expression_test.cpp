#include "sim/expression/expression.h"

#include "sim/base/check.h"
#include "sim/base/math.h"
#include "sim/expression/vocabulary.h"

#include <array>
#include <clocale>
#include <cmath>
#include <gtest/gtest.h>

namespace rend::expression_test {
namespace {

using Vector = std::array<double, 3>;

TEST(Expression, binds_operators_as_mathematics_does) {
  EXPECT_EQ(scalar_of("1 + 2 * 3"), 7);
  EXPECT_EQ(scalar_of("(1 + 2) * 3"), 9);
  EXPECT_EQ(scalar_of("10 - 4 - 3"), 3);
  EXPECT_EQ(scalar_of("10 - (4 - 3)"), 9);
  EXPECT_EQ(scalar_of("0.1 + 0.2 - 0.3"), 0.1 + 0.2 - 0.3);
  EXPECT_EQ(scalar_of("100 / 10 / 5"), 2);
  EXPECT_EQ(scalar_of("100 / 10 * 5"), 50);
  EXPECT_EQ(scalar_of("2 ^ 3 ^ 2"), 512);
  EXPECT_EQ(scalar_of("(2 ^ 3) ^ 2"), 64);
  EXPECT_EQ(scalar_of("2 * 3 ^ 2"), 18);
  EXPECT_EQ(scalar_of("-2 ^ 2"), -4);
  EXPECT_EQ(scalar_of("(-2) ^ 2"), 4);
  EXPECT_EQ(scalar_of("2 ^ -1"), 0.5);
  EXPECT_EQ(scalar_of("2 ^ -1 * 8"), 4);
  EXPECT_EQ(scalar_of("2 * -3"), -6);
  EXPECT_EQ(scalar_of("2 - -3"), 5);
  EXPECT_EQ(scalar_of("--3"), 3);
  EXPECT_EQ(scalar_of("-2 * -3 - 1"), 5);
}

TEST(Expression, binds_conditions_as_the_header_says) {
  EXPECT_TRUE(condition_of("1 + 1 == 2"));
  EXPECT_TRUE(condition_of("1 < 2 and 2 < 3"));
  EXPECT_TRUE(condition_of("1 < 2 or 1 < 2 and 2 < 1")); // or binds more loosely
  EXPECT_FALSE(condition_of("(1 < 2 or 1 < 2) and 2 < 1"));
  EXPECT_FALSE(condition_of("not 1 < 2"));
  EXPECT_TRUE(condition_of("not 2 < 1 and 1 < 2"));
  EXPECT_FALSE(condition_of("not (2 < 1 or 1 < 2)"));
  EXPECT_TRUE(condition_of("not not free"));
  for (const auto& [text, expected] : {std::pair{"1 <= 1", true},
                                       {"1 >= 2", false},
                                       {"1 > 1", false},
                                       {"2 != 2", false},
                                       {"2 != 3", true},
                                       {"2 == 3", false},
                                       {"1 >= 1", true}})
    EXPECT_EQ(condition_of(text), expected) << text;
}

TEST(Expression, computes_with_vectors) {
  EXPECT_EQ(vector_of("centre + 2 * centre - centre / 2"), (Vector{2.5, 5, 7.5}));
  EXPECT_EQ(vector_of("-centre * 2"), (Vector{-2, -4, -6}));
  EXPECT_EQ(vector_of("cross(point(1, 0, 0), point(0, 1, 0))"), (Vector{0, 0, 1}));
  EXPECT_EQ(scalar_of("dot(centre, point(1, 10, 100))"), 321);
  EXPECT_EQ(scalar_of("norm(point(2, 3, 6))"), 7);
  EXPECT_EQ(scalar_of("x(centre) + 10 * y(centre) + 100 * z(centre)"), 321);
}

TEST(Expression, knows_the_usual_functions) {
  EXPECT_EQ(scalar_of("sin(1)"), sine(1));
  EXPECT_NEAR(scalar_of("cos(pi / 3) + tan(pi / 4)"), 1.5, 1e-15);
  EXPECT_NEAR(scalar_of("log(exp(3)) + pow(2, 0.5) * sqrt(2)"), 5, 1e-14);
  EXPECT_EQ(scalar_of("abs(-3) + floor(-0.5) + floor(2.5)"), 4);
  EXPECT_EQ(scalar_of("min(1, 2) + 10 * max(1, 2)"), 21);
  EXPECT_EQ(scalar_of("step(1, 0.9) + 10 * step(1, 1)"), 10);
  EXPECT_EQ(scalar_of("clamp(-1, 0, 1) + clamp(2, 0, 1) + clamp(0.5, 0, 1)"), 1.5);
  EXPECT_NE(scalar_of("noise(centre)"), scalar_of("noise(centre, 1)"));
  EXPECT_EQ(scalar_of("noise(centre)"), scalar_of("noise(centre, 0)"));
}

TEST(Expression, reads_numbers_in_every_locale) {
  EXPECT_EQ(scalar_of("1e-4"), 1e-4);
  EXPECT_EQ(scalar_of(".5 + 2. + 1E2"), 102.5);
  EXPECT_EQ(scalar_of("4e-320"), 4e-320);
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* locale : {"de_DE.UTF-8", "fr_FR.UTF-8"})
    if (std::setlocale(LC_ALL, locale)) {
      EXPECT_EQ(scalar_of("1.5"), 1.5);
      EXPECT_EQ(Expression("1.5", {}, ValueType::Scalar).print(), "1.5");
    }
  std::setlocale(LC_ALL, before.c_str());
}

TEST(Expression, hands_calls_to_the_caller) {
  const Expression one("size(a, face) > 3 and mixed(2 * time, long_name, copy(b)) < plus(1) + plus(1, 2, cc)",
                       test_vocabulary(), ValueType::Condition);
  ASSERT_EQ(one.calls().size(), 6);
  EXPECT_EQ(one.calls()[0].names, (std::vector<std::string>{"a", "face"}));
  EXPECT_EQ(one.calls()[0].columns, (std::vector<std::size_t>{6, 9}));
  EXPECT_EQ(one.calls()[0].column, 1);
  EXPECT_EQ(one.calls()[1].name, "time");
  EXPECT_EQ(one.calls()[2].name, "copy");
  EXPECT_EQ(one.calls()[3].name, "mixed");
  EXPECT_EQ(test_vocabulary()[one.calls()[3].function].name, "mixed");
  EXPECT_EQ(one.calls()[4].arguments.size(), 1);
  EXPECT_EQ(one.calls()[5].names, (std::vector<std::string>{"cc"}));
  EXPECT_FALSE(one.constant());
  EXPECT_TRUE(one.evaluate(TestSupply()).condition() == (5 > 3 && 1 + 9 + 2 < 1 + 5));
  EXPECT_EQ(scalar_of("mixed(2 * time, long_name, copy(b))"), 1 + 9 + 2);
  EXPECT_EQ(scalar_of("either(time > 1, 2, 3)"), 3);

  std::vector<std::size_t> asked;
  const Expression sum("time + 10 * area(a)", test_vocabulary(), ValueType::Scalar);
  sum.evaluate([&](const ExpressionCall&, std::size_t number, std::span<const Value> given) {
    EXPECT_TRUE(given.empty());
    asked.push_back(number);
    return scalar_value(1);
  });
  EXPECT_EQ(asked, (std::vector<std::size_t>{0, 1}));
}

TEST(Expression, leaves_out_what_does_not_decide) {
  EXPECT_FALSE(condition_of("time > 1 and 1 / (time - 0.5) > 0"));
  EXPECT_TRUE(condition_of("time < 1 or 1 / (time - 0.5) > 0"));
  EXPECT_EQ(refusal("time < 1 and 1 / (time - 0.5) > 0", ValueType::Condition),
            "column 16: 1 / 0 is not a finite number");
  EXPECT_TRUE(condition_of("time > 1 and broken > 0 or time < 1"));
  EXPECT_FALSE(condition_of("(time < 1 or broken > 0) and time > 1"));
}

TEST(Expression, refuses_values_that_are_not_finite) {
  EXPECT_EQ(refusal("1/0"), "column 2: 1 / 0 is not a finite number");
  EXPECT_EQ(refusal("2 + sqrt(-1)"), "column 5: sqrt(-1) is not a finite number");
  EXPECT_EQ(refusal("1e308*10"), "column 6: 1e+308 * 10 is not a finite number");
  EXPECT_EQ(refusal("1 / (1 / (time - 0.5))"), "column 8: 1 / 0 is not a finite number");
  EXPECT_EQ(refusal("log(0)"), "column 1: log(0) is not a finite number");
  EXPECT_EQ(refusal("(-8) ^ 0.5"), "column 6: (-8) ^ 0.5 is not a finite number");
  EXPECT_EQ(refusal("x(centre / 0)"), "column 10: (1, 2, 3) / 0 is not a finite number");
  EXPECT_EQ(refusal("1 + broken"), "column 5: the value of 'broken' is not a finite number");
  // A constant one is refused before anything asks for its value.
  EXPECT_THROW(Expression("1 / 0", {}, ValueType::Scalar), ExpressionError);
  EXPECT_NO_THROW(Expression("1 / (time - 0.5)", test_vocabulary(), ValueType::Scalar));
}

TEST(Expression, refuses_operands_without_a_meaning) {
  // Every operator with every pair of types; one of each type, as text.
  const std::array<std::string, 3> operand = {"time", "centre", "free"};
  const std::array<ValueType, 3> type = {ValueType::Scalar, ValueType::Vector, ValueType::Condition};
  const auto allowed = [](const std::string& op, int a, int b, int& result) {
    result = 0;
    if (op == "and" || op == "or") return result = 2, a == 2 && b == 2;
    if (op == "+" || op == "-") return result = a, a == b && a != 2;
    if (op == "*") return result = a + b, a + b < 2;
    if (op == "/") return result = a, a != 2 && b == 0;
    if (op == "^") return a == 0 && b == 0;
    return result = 2, a == 0 && b == 0;
  };
  int refused = 0;
  for (const std::string op : {"and", "or", "+", "-", "*", "/", "^", "<", "<=", ">", ">=", "==", "!="})
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        const std::string text = operand[a] + " " + op + " " + operand[b];
        int result = 0;
        if (allowed(op, a, b, result)) {
          EXPECT_EQ(refusal(text, type[result]), "") << text;
          continue;
        }
        ++refused;
        for (const ValueType wanted : type) {
          const std::string why = refusal(text, wanted);
          EXPECT_TRUE(
              why.starts_with("column " + std::to_string(operand[a].size() + 2) + ": '" + op + "' takes "))
              << text << ": " << why;
        }
      }
  EXPECT_EQ(refused, 13 * 9 - (1 + 1 + 2 + 2 + 3 + 2 + 1 + 6));
  EXPECT_EQ(refusal("-free"), "column 1: '-' takes a scalar or a vector, here a condition");
  EXPECT_TRUE(
      refusal("not time", ValueType::Condition).starts_with("column 1: 'not' takes a condition, here a sc"));
  EXPECT_TRUE(
      refusal("not centre", ValueType::Condition).starts_with("column 1: 'not' takes a condition, here a v"));
}

TEST(Expression, explains_refused_operands) {
  EXPECT_EQ(refusal("centre * centre"), "column 8: '*' takes two scalars, or a scalar and a vector, here two "
                                        "vectors | products of vectors are dot(u, v) and cross(u, v)");
  EXPECT_EQ(refusal("1 < 2 < 3"), "column 7: '<' takes two scalars, here a condition and a scalar | "
                                  "comparisons are joined by 'and': a < b and b < c");
  EXPECT_EQ(refusal("centre"), "column 1: the expression is a vector, where a scalar is wanted");
  EXPECT_EQ(refusal("time", ValueType::Vector),
            "column 1: the expression is a scalar, where a vector is wanted | a vector is point(x, y, z)");
  EXPECT_EQ(refusal("sqrt(centre)"),
            "column 6: argument 1 of 'sqrt' is a scalar, here a vector | sqrt(scalar)");
  EXPECT_EQ(refusal("area(1 + 2)"), "column 6: argument 1 of 'area' is a name, a single word | area(name)");
  EXPECT_EQ(refusal("area(a + b)"), "column 6: argument 1 of 'area' is a name, a single word | area(name)");
}

TEST(Expression, names_what_is_near_a_misspelt_name) {
  EXPECT_TRUE(refusal("aera(a)").starts_with("column 1: there is no function 'aera' | did you mean 'area'? "));
  EXPECT_TRUE(
      refusal("2 * srqt(2)").starts_with("column 5: there is no function 'srqt' | did you mean 'sqrt'? "));
  EXPECT_EQ(refusal("1 + tiem"),
            "column 5: there is no value 'tiem' | did you mean 'time'? values: time, centre, "
            "free, broken, pi");
  EXPECT_EQ(refusal("area"), "column 1: 'area' is a function | write area(name)");
  EXPECT_EQ(refusal("noise"), "column 1: 'noise' is a function | write noise(vector[, scalar])");
  EXPECT_EQ(refusal("time()"), "column 1: 'time' takes no arguments | write time");
}

TEST(Expression, names_the_place_of_errors_of_form) {
  EXPECT_EQ(refusal(""), "column 1: the expression is empty");
  EXPECT_EQ(refusal(" \t\n"), "column 1: the expression is empty");
  EXPECT_EQ(refusal("1 +"), "column 4: the expression ends where a value is expected");
  EXPECT_EQ(refusal("1 + * 2"), "column 5: a value is expected before '*'");
  EXPECT_EQ(refusal("(1 + 2"), "column 7: ')' is missing, which closes '(' of column 1");
  EXPECT_EQ(refusal("1 + 2)"), "column 6: this ')' closes nothing");
  EXPECT_EQ(refusal("1 2"),
            "column 3: an operator is expected before '2' | a vector is written as point(x, y, z)");
  EXPECT_EQ(refusal("(1 2)"),
            "column 4: an operator is expected before '2' | a vector is written as point(x, y, z)");
  EXPECT_EQ(refusal("2time"),
            "column 1: '2time' is not a number | numbers are as 2, 0.5 or 1e-4; a product has its "
            "'*'");
  EXPECT_TRUE(refusal("1.2.3").starts_with("column 1: '1.2.3' is not a number"));
  EXPECT_TRUE(refusal("0x10").starts_with("column 1: '0x10' is not a number"));
  EXPECT_EQ(refusal("1e999"), "column 1: '1e999' is too large or too small for a number of 64 bits");
  EXPECT_EQ(refusal("1,5"),
            "column 2: ',' stands outside the arguments of a function | the decimal point is '.'; a "
            "vector is point(x, y, z)");
  EXPECT_EQ(refusal("min(1)"), "column 6: 'min' takes 2 arguments, here is 1 | min(scalar, scalar)");
  EXPECT_EQ(refusal("min(1, 2, 3)"), "column 11: 'min' takes 2 arguments, here are more | min(scalar, scalar)");
  EXPECT_EQ(refusal("plus()"),
            "column 6: 'plus' takes at least 1 argument, here are 0 | plus(scalar[, scalar[, name]])");
  EXPECT_EQ(refusal("time = 1"), "column 6: '=' is not known here | write '=='");
  EXPECT_EQ(refusal("2 ** 3"), "column 3: '**' is not known here | write '^'");
  EXPECT_EQ(refusal("time && free"), "column 6: '&&' is not known here | write 'and'");
  EXPECT_EQ(refusal("1 − 2"), "column 3: '−' is not known here | write '-'");
  EXPECT_EQ(refusal("1 \x1b[2J"), "column 3: '\\x1b' is not known here");
  EXPECT_EQ(refusal("1 $"), "column 3: '$' is not known here");
  EXPECT_EQ(refusal("and"), "column 1: a value is expected before 'and'");
  EXPECT_EQ(refusal("+1"), "column 1: a value is expected before '+'");
}

TEST(Expression, prints_a_normal_form) {
  const auto printed = [](const std::string& text, ValueType wanted = ValueType::Scalar) {
    return Expression(text, test_vocabulary(), wanted).print();
  };
  EXPECT_EQ(printed("((1))+(2*(3))"), "1 + 2*3");
  EXPECT_EQ(printed("(1+2)*3-(4-(5-6))"), "(1 + 2)*3 - (4 - (5 - 6))");
  EXPECT_EQ(printed("(2^3)^2 + 2^(3^2) + (-2)^2 + -(2^2) + 2^(-1)"), "(2^3)^2 + 2^3^2 + (-2)^2 + -2^2 + 2^-1");
  EXPECT_EQ(printed("-(-1) - (-(1*2))"), "--1 - -(1*2)");
  EXPECT_EQ(printed("1.50e0 * .5 + 100000"), "1.5*0.5 + 100000");
  EXPECT_EQ(printed("not(free and(time<1)) or not(not free)", ValueType::Condition),
            "not (free and time < 1) or not not free");
  EXPECT_EQ(printed("mixed( 1,a , 2*centre )+plus(1,2)+noise(centre)+pi"),
            "mixed(1, a, 2*centre) + plus(1, 2) + noise(centre) + pi");
}

TEST(Expression, of_a_wrong_vocabulary_is_a_bug_of_the_caller) {
  const auto with = [](const ExpressionFunction& one) { Expression("1", {one}, ValueType::Scalar); };
  EXPECT_NO_THROW(with({"one", {}, ValueType::Scalar, ""}));
  EXPECT_THROW(with({"sin", {}, ValueType::Scalar, ""}), InternalError);
  EXPECT_THROW(with({"and", {}, ValueType::Scalar, ""}), InternalError);
  EXPECT_THROW(with({"two words", {}, ValueType::Scalar, ""}), InternalError);
  EXPECT_THROW(with({"one", {}, ValueType::Name, ""}), InternalError);
  EXPECT_THROW(with({"one", {}, ValueType::Scalar, "", 1}), InternalError);
}

} // namespace
} // namespace rend::expression_test
