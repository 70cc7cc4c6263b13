#include "sim/expression/functions.h"

#include "sim/base/math.h"
#include "sim/expression/noise.h"
#include "sim/expression/rates.h"

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

template <double (*function)(double)> Value of_scalar(const Value* a, std::size_t) {
  return scalar_value(function(a->scalar()));
}
template <int axis> Value component(const Value* a, std::size_t) {
  return scalar_value(a->number[axis]);
}

double square_root(double x) {
  return std::sqrt(x);
}
double size_of_number(double x) {
  return std::abs(x);
}
double whole_below(double x) {
  return std::floor(x);
}

double product(const Value& a, const Value& b) {
  const auto &u = a.number, &v = b.number;
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

Value cross_product(const Value* a, std::size_t) {
  const auto &u = a[0].number, &v = a[1].number;
  return vector_value(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
}

Value clamped(const Value* a, std::size_t) {
  return scalar_value(std::min(std::max(a[0].scalar(), a[1].scalar()), a[2].scalar()));
}

Value noise_there(const Value* a, std::size_t count) {
  return scalar_value(noise(a[0].vector(), count > 1 ? a[1].scalar() : 0));
}

} // namespace

const std::vector<BuiltIn>& built_ins() {
  constexpr ValueType S = ValueType::Scalar, V = ValueType::Vector;
  static const std::vector<BuiltIn> all = {
      {{"pi", {}, S, "3.14159..."}, [](const Value*, std::size_t) { return scalar_value(pi); }},
      {{"sin", {S}, S, "sine of an angle in radians"}, of_scalar<sine>, rates::of_sine},
      {{"cos", {S}, S, "cosine of an angle in radians"}, of_scalar<cosine>, rates::of_cosine},
      {{"tan", {S}, S, "tangent of an angle in radians"}, of_scalar<tangent>, rates::of_tangent},
      {{"exp", {S}, S, "e to that power"}, of_scalar<exponential>, rates::of_exponential},
      {{"log", {S}, S, "natural logarithm"}, of_scalar<logarithm>, rates::of_logarithm},
      {{"sqrt", {S}, S, "square root"}, of_scalar<square_root>, rates::of_square_root},
      {{"abs", {S}, S, "the number without its sign"}, of_scalar<size_of_number>, rates::of_size},
      {{"floor", {S}, S, "the largest whole number that is not above it"}, of_scalar<whole_below>},
      {{"min", {S, S}, S, "the smaller one"},
       [](const Value* a, std::size_t) { return scalar_value(std::min(a[0].scalar(), a[1].scalar())); },
       rates::of_minimum},
      {{"max", {S, S}, S, "the larger one"},
       [](const Value* a, std::size_t) { return scalar_value(std::max(a[0].scalar(), a[1].scalar())); },
       rates::of_maximum},
      {{"pow", {S, S}, S, "pow(x, y) is x^y"},
       [](const Value* a, std::size_t) { return scalar_value(power(a[0].scalar(), a[1].scalar())); },
       rates::of_power},
      {{"step", {S, S}, S, "step(edge, x): 0 if x < edge, else 1"},
       [](const Value* a, std::size_t) { return scalar_value(a[1].scalar() < a[0].scalar() ? 0 : 1); }},
      {{"clamp", {S, S, S}, S, "clamp(x, lo, hi): x, or the nearer of lo and hi if it lies outside them"},
       clamped,
       rates::of_clamp},
      {{"point", {S, S, S}, V, "a vector"},
       [](const Value* a, std::size_t) { return vector_value(a[0].scalar(), a[1].scalar(), a[2].scalar()); },
       rates::of_point},
      {{"dot", {V, V}, S, "scalar product"},
       [](const Value* a, std::size_t) { return scalar_value(product(a[0], a[1])); },
       rates::of_dot},
      {{"cross", {V, V}, V, "vector product"}, cross_product, rates::of_cross},
      {{"norm", {V}, S, "length of the vector"},
       [](const Value* a, std::size_t) { return scalar_value(std::sqrt(product(a[0], a[0]))); },
       rates::of_norm},
      {{"x", {V}, S, ""}, component<0>, rates::of_component<0>},
      {{"y", {V}, S, ""}, component<1>, rates::of_component<1>},
      {{"z", {V}, S, "its components"}, component<2>, rates::of_component<2>},
      {{"noise", {V, S}, S, "smooth, irregular, in [0, 1); of place, seed", 1},
       noise_there,
       rates::of_noise},
  };
  return all;
}

} // namespace rend
