// A vocabulary such as a rule's, with values that the tests know.
#pragma once

#include "sim/expression/expression.h"

#include <span>
#include <string>
#include <vector>

namespace rend {

inline const std::vector<ExpressionFunction>& test_vocabulary() {
  constexpr ValueType S = ValueType::Scalar, V = ValueType::Vector, C = ValueType::Condition;
  constexpr ValueType N = ValueType::Name;
  static const std::vector<ExpressionFunction> all = {
      {"time", {}, S, "0.5"},
      {"centre", {}, V, "(1, 2, 3)"},
      {"free", {}, C, "true"},
      {"size", {N, N}, S, "letters of both names"},
      {"area", {N}, S, "letters of the name, times 0.25"},
      {"copy", {N}, V, "(letters, 0, 1)"},
      {"lerp", {N, N, S}, V, "point(letters of a, letters of b, t)"},
      {"mixed", {S, N, V}, S, "the scalar + letters + the vector's components"},
      {"plus", {S, S, N}, S, "the sum of the numbers there are, plus letters", 2},
      {"either", {C, S, S}, S, "the second or the third"},
      {"broken", {}, S, "not a number"},
  };
  return all;
}

struct TestSupply {
  Value operator()(const ExpressionCall& call, std::size_t, std::span<const Value> given) const {
    const auto letters = [&](std::size_t n) { return static_cast<double>(call.names[n].size()); };
    const std::string& name = call.name;
    if (name == "time") return scalar_value(0.5);
    if (name == "centre") return vector_value(1, 2, 3);
    if (name == "free") return condition_value(true);
    if (name == "size") return scalar_value(letters(0) + letters(1));
    if (name == "area") return scalar_value(0.25 * letters(0));
    if (name == "copy") return vector_value(letters(0), 0, 1);
    if (name == "lerp") return vector_value(letters(0), letters(1), given[0].scalar());
    if (name == "mixed") {
      const auto& v = given[1].vector();
      return scalar_value(given[0].scalar() + letters(0) + v[0] + v[1] + v[2]);
    }
    if (name == "plus") {
      double sum = 0;
      for (const Value& one : given) sum += one.scalar();
      return scalar_value(call.names.empty() ? sum : sum + letters(0));
    }
    if (name == "either") return scalar_value(given[given[0].condition() ? 1 : 2].scalar());
    return scalar_value(0.0 / (call.name == "broken" ? 0.0 : 1.0));
  }
};

inline Value evaluated(const std::string& text, ValueType wanted) {
  return Expression(text, test_vocabulary(), wanted).evaluate(TestSupply());
}
inline double scalar_of(const std::string& text) {
  return evaluated(text, ValueType::Scalar).scalar();
}
inline std::array<double, 3> vector_of(const std::string& text) {
  return evaluated(text, ValueType::Vector).vector();
}
inline bool condition_of(const std::string& text) {
  return evaluated(text, ValueType::Condition).condition();
}

// "column 3: what is wrong | hint"; "" where nothing is.
inline std::string refusal(const std::string& text, ValueType wanted = ValueType::Scalar) {
  try {
    evaluated(text, wanted);
  } catch (const ExpressionError& error) {
    return error.what() + (error.hint.empty() ? "" : " | " + error.hint);
  }
  return {};
}

} // namespace rend
