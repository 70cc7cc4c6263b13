// Values of expressions, and their types.
#pragma once

#include <array>
#include <cstddef>

namespace rend {

enum class ValueType {
  Scalar,
  Vector,    // three scalars
  Condition, // true or false
  Name,      // a bare word, such as that of a node or an orbit; only an argument of a function of the caller
};

// Which of the types a value has is known where the expression is compiled, and not stored in it.
struct Value {
  std::array<double, 3> number; // a scalar and a condition (1 or 0) take the first; the others are 0

  double scalar() const { return number[0]; }
  const std::array<double, 3>& vector() const { return number; }
  bool condition() const { return number[0] != 0; }
};

inline Value scalar_value(double x) {
  return {{x, 0, 0}};
}
inline Value vector_value(double x, double y, double z) {
  return {{x, y, z}};
}
inline Value condition_value(bool holds) {
  return {{holds ? 1.0 : 0.0, 0, 0}};
}

// Computes a value from `count` others, which begin at `arguments`.
using Apply = Value (*)(const Value* arguments, std::size_t count);

// The rate of change of that value, where the arguments change at these rates (rates.h).
using Rate = Value (*)(const Value* arguments, const Value* rates, std::size_t count);

struct ValueAndRate {
  Value value, rate;
};

} // namespace rend
