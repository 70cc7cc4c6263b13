// The order that errors show: the slope of log error over log step, by least squares, with its confidence
// interval.
//
//   log e = a + p log h,   p ± t s_p,   s_p² = Σ r²/(n − 2) / Σ (log h − mean)²
//
// t: Student's quantile of 97.5 % with n − 2 degrees of freedom, so that the interval holds the slope 95 times
// in 100 if the residuals r are independent and normal (Draper & Smith, Applied Regression Analysis, 1.4).
// Errors of a scheme are neither, but the interval still says how straight the line is.
//
// An order is a statement about small steps. Points that say nothing of it are left out, by one rule for all
// schemes:
//   1. runs that failed;
//   2. errors above `largest` (nothing is small there), and at or below `smallest` (they are the reference's as
//      well);
//   3. of the rest, from the smallest step up, the first row of at least three neighbours, a factor of two
//      wide, whose local orders, log(e_i/e_j) / log(h_i/h_j), stay within `spread` of each other.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace rend {

struct OrderPoint {
  double step = 0;     // [s]
  double error = 0;    // any unit
  bool failed = false; // its error means nothing
};

struct OrderRule {
  double largest = 0.1; // error
  double smallest = 0;  // error: ten times the reference's error bar
  double spread = 0.3;  // of local orders
  std::string words() const;
};

struct OrderFit {
  double order = 0, low = 0, high = 0; // and its 95 % confidence interval
  double constant = 0;                 // the error at a step of 1 s, by the fit
  std::vector<std::size_t> used;       // of the points, increasing steps
};

// None: fewer than three points are left.
std::optional<OrderFit> fit_order(const std::vector<OrderPoint>& points, const OrderRule& rule);

struct StraightLine {
  double slope = 0, at_zero = 0;
  double slope_error = 0; // standard error of the slope
};
StraightLine least_squares(const std::vector<double>& x, const std::vector<double>& y); // at least 3 (CHECK)

// t such that Student's variable with so many degrees of freedom (≥ 1) is below it with this probability (0.5
// to 1).
double student_t(double probability, int freedom);

} // namespace rend
