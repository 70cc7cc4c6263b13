#include "sim/expression/rates.h"

#include "sim/base/math.h"
#include "sim/expression/noise.h"

#include <cmath>

namespace rend::rates {
namespace {

// A contribution to a rate; none where the argument does not change.
double part(double derivative, double rate) {
  return rate == 0 ? 0 : derivative * rate;
}

Value scaled(const Value& v, double by) {
  return vector_value(v.number[0] * by, v.number[1] * by, v.number[2] * by);
}
Value sum(const Value& a, const Value& b) {
  return vector_value(a.number[0] + b.number[0], a.number[1] + b.number[1], a.number[2] + b.number[2]);
}
double product(const Value& a, const Value& b) {
  const auto &u = a.number, &v = b.number;
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}
Value cross(const Value& a, const Value& b) {
  const auto &u = a.number, &v = b.number;
  return vector_value(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
}

} // namespace

Value of_sum(const Value*, const Value* rates, std::size_t) {
  return sum(rates[0], rates[1]);
}
Value of_difference(const Value*, const Value* rates, std::size_t) {
  return sum(rates[0], scaled(rates[1], -1));
}
Value of_opposite(const Value*, const Value* rates, std::size_t) {
  return scaled(*rates, -1);
}
Value of_product(const Value* a, const Value* rates, std::size_t) {
  return scalar_value(part(a[1].scalar(), rates[0].scalar()) + part(a[0].scalar(), rates[1].scalar()));
}
Value of_scalar_times_vector(const Value* a, const Value* rates, std::size_t) {
  return sum(scaled(a[1], rates[0].scalar()), scaled(rates[1], a[0].scalar()));
}
Value of_vector_times_scalar(const Value* a, const Value* rates, std::size_t) {
  return sum(scaled(rates[0], a[1].scalar()), scaled(a[0], rates[1].scalar()));
}
Value of_quotient(const Value* a, const Value* rates, std::size_t) {
  const double by = a[1].scalar(), change = rates[1].scalar() / by;
  return scaled(sum(rates[0], scaled(a[0], -change)), 1 / by);
}

Value of_power(const Value* a, const Value* rates, std::size_t) {
  const double x = a[0].scalar(), y = a[1].scalar();
  const double by_base = y == 0 ? 0 : part(y * power(x, y - 1), rates[0].scalar());
  const double by_exponent = x == 0 && y > 0 ? 0 : part(power(x, y) * logarithm(x), rates[1].scalar());
  return scalar_value(by_base + (rates[1].scalar() == 0 ? 0 : by_exponent));
}

Value of_sine(const Value* a, const Value* rates, std::size_t) {
  return scalar_value(part(cosine(a->scalar()), rates->scalar()));
}
Value of_cosine(const Value* a, const Value* rates, std::size_t) {
  return scalar_value(part(-sine(a->scalar()), rates->scalar()));
}
Value of_tangent(const Value* a, const Value* rates, std::size_t) {
  const double t = tangent(a->scalar());
  return scalar_value(part(1 + t * t, rates->scalar()));
}
Value of_exponential(const Value* a, const Value* rates, std::size_t) {
  return scalar_value(part(exponential(a->scalar()), rates->scalar()));
}
Value of_logarithm(const Value* a, const Value* rates, std::size_t) {
  return scalar_value(part(1 / a->scalar(), rates->scalar()));
}
Value of_square_root(const Value* a, const Value* rates, std::size_t) {
  return scalar_value(part(0.5 / std::sqrt(a->scalar()), rates->scalar()));
}
Value of_size(const Value* a, const Value* rates, std::size_t) {
  const double x = a->scalar();
  return scalar_value(x > 0 ? rates->scalar() : x < 0 ? -rates->scalar() : 0);
}

Value of_minimum(const Value* a, const Value* rates, std::size_t) {
  return rates[a[1].scalar() < a[0].scalar() ? 1 : 0];
}
Value of_maximum(const Value* a, const Value* rates, std::size_t) {
  return rates[a[0].scalar() < a[1].scalar() ? 1 : 0];
}
Value of_clamp(const Value* a, const Value* rates, std::size_t) {
  const std::size_t lower = a[0].scalar() < a[1].scalar() ? 1 : 0; // as max, then min
  return rates[a[2].scalar() < a[lower].scalar() ? 2 : lower];
}

Value of_point(const Value*, const Value* rates, std::size_t) {
  return vector_value(rates[0].scalar(), rates[1].scalar(), rates[2].scalar());
}
Value of_dot(const Value* a, const Value* rates, std::size_t) {
  return scalar_value(product(rates[0], a[1]) + product(a[0], rates[1]));
}
Value of_cross(const Value* a, const Value* rates, std::size_t) {
  return sum(cross(rates[0], a[1]), cross(a[0], rates[1]));
}
Value of_norm(const Value* a, const Value* rates, std::size_t) {
  const double length = std::sqrt(product(*a, *a));
  return scalar_value(length > 0 ? product(*a, *rates) / length : 0);
}

Value of_noise(const Value* a, const Value* rates, std::size_t count) {
  const auto gradient = noise_gradient(a[0].vector(), count > 1 ? a[1].scalar() : 0);
  return scalar_value(product({gradient}, rates[0]));
}

} // namespace rend::rates
