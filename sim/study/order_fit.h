// The observed order of convergence: the slope of log error over log step, by least squares, with its
// confidence interval.
//
//   log e = a + p log h,   p ± t s_p,   s_p² = Σ r²/(n − 2) / Σ (log h − mean)²
//
// t: Student's quantile of 97.5 % with n − 2 degrees of freedom, so that the interval contains the slope in 95
// of 100 cases if the residuals r are independent and normal (Draper & Smith, Applied Regression Analysis,
// 1.4). Errors of a scheme are neither, but the interval still measures how straight the line is.
//
// The order refers to small steps. Points outside that range are left out, by one rule for all schemes:
//   1. runs that failed;
//   2. errors above `largest` (not asymptotic), and at or below `smallest` (errors of the reference);
//   3. of the rest, from the smallest step up, the first sequence of at least three neighbours, a factor of two
//      wide, whose local orders, log(e_i/e_j) / log(h_i/h_j), differ by at most `spread`.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace rend {

struct OrderPoint {
  double step = 0;     // [s]
  double error = 0;    // its error is meaningless
  bool failed = false; // its error means nothing
};

struct OrderRule {
  double largest = 0.1; // error
  double smallest = 0;  // error: ten times the reference's error bar
  double spread = 0.3;  // of local orders
  std::string words() const;
};

struct OrderFit {
  double order = 0, low = 0, high = 0; // with its 95 % confidence interval
  double constant = 0;                 // the fitted error at a step of 1 s
  std::vector<std::size_t> used;       // indices of the points, in order of increasing steps
};

// nullopt: fewer than three points remain.
std::optional<OrderFit> fit_order(const std::vector<OrderPoint>& points, const OrderRule& rule);

struct StraightLine {
  double slope = 0, at_zero = 0;
  double slope_error = 0; // standard error of the slope
};
StraightLine least_squares(const std::vector<double>& x, const std::vector<double>& y); // at least 3 (CHECK)

// t such that a variable with Student's distribution of `freedom` degrees of freedom (≥ 1) is below it with
// this probability (0.5 to 1).
double student_t(double probability, int freedom);

} // namespace rend
