// A number as the sum of two doubles, of some 106 bits: what power() and the sine of large angles need inside.
//
//   a + b = s + t,   a b = p + q   without any error, where s and p are the rounded sum and product
//
// (Knuth's sum, Dekker's product: T. J. Dekker, A floating-point technique for extending the available
// precision, Numerische Mathematik 18, 1971). Errors of +, * and / are a few 1e-32 of the result, of + where
// the terms do not cancel. Factors must be below 1e290. No fused multiply-add, which not every processor has.
#pragma once

namespace rend {

struct DoubleDouble {
  double high = 0, low = 0; // |low| ≤ half a unit in the last place of high
};

inline DoubleDouble exact_sum(double a, double b) {
  const double sum = a + b, part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}

// The same where |a| ≥ |b|.
inline DoubleDouble ordered_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

inline DoubleDouble exact_product(double a, double b) {
  constexpr double split = 134217729; // 2²⁷ + 1: halves of 26 bits, whose products are exact
  const double wide_a = split * a, wide_b = split * b;
  const double high_a = wide_a - (wide_a - a), high_b = wide_b - (wide_b - b);
  const double low_a = a - high_a, low_b = b - high_b;
  const double product = a * b;
  return {product, ((high_a * high_b - product) + high_a * low_b + low_a * high_b) + low_a * low_b};
}

inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble sum = exact_sum(a.high, b.high);
  return ordered_sum(sum.high, sum.low + (a.low + b.low));
}

inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble product = exact_product(a.high, b.high);
  return ordered_sum(product.high, product.low + (a.high * b.low + a.low * b.high));
}

inline DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
  const double quotient = a.high / b.high;
  const DoubleDouble taken = b * DoubleDouble{quotient, 0};
  return ordered_sum(quotient, ((a.high - taken.high) - taken.low + a.low) / b.high);
}

} // namespace rend
