#include "sim/study/order_fit.h"

#include "sim/base/check.h"
#include "sim/base/math.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

constexpr double least_span = 2; // ratio of the largest to the smallest step

// The probability that |t| of Student's distribution is below `t` (Abramowitz & Stegun 26.7.3 and 26.7.4).
double within(double t, int freedom) {
  const double theta = std::atan(t / std::sqrt(freedom)), cosine = std::cos(theta), sine = std::sin(theta);
  double term = freedom % 2 ? cosine : 1, sum = freedom == 1 ? 0 : term;
  for (int k = freedom % 2 ? 3 : 2; k < freedom; k += 2) {
    term *= cosine * cosine * (k - 1) / k;
    sum += term;
  }
  return freedom % 2 ? 2 / pi * (theta + sine * sum) : sine * sum;
}

// The first sequence of at least three neighbours, from the smallest step up, whose local orders differ by at
// most the spread; indices into `points`.
std::vector<std::size_t> straight(const std::vector<OrderPoint>& points, const std::vector<std::size_t>& sorted,
                                  double spread) {
  std::vector<double> orders;
  for (std::size_t n = 0; n + 1 < sorted.size(); ++n) {
    const OrderPoint &fine = points[sorted[n]], &coarse = points[sorted[n + 1]];
    orders.push_back(std::log(coarse.error / fine.error) / std::log(coarse.step / fine.step));
  }
  for (std::size_t first = 0; first < orders.size(); ++first) {
    double low = orders[first], high = low;
    std::size_t last = first;
    for (; last < orders.size(); ++last) {
      low = std::min(low, orders[last]);
      high = std::max(high, orders[last]);
      if (high - low > spread) break;
    }
    const double span = points[sorted[last]].step / points[sorted[first]].step;
    if (last - first >= 2 && span >= least_span)
      return {sorted.begin() + static_cast<std::ptrdiff_t>(first),
              sorted.begin() + static_cast<std::ptrdiff_t>(last + 1)};
  }
  return {};
}

} // namespace

std::string OrderRule::words() const {
  return fmt::format(
      "A fit leaves out runs that failed, errors above {:g} (nothing is small there) and errors at or "
      "below {:.2g} (ten times the error bar of the reference); of the rest it takes, from the smallest "
      "step up, the first row of three or more neighbouring steps, at least a factor of {:g} wide, whose local "
      "orders stay within {:g} of "
      "each other.",
      largest, smallest, least_span, spread);
}

std::optional<OrderFit> fit_order(const std::vector<OrderPoint>& points, const OrderRule& rule) {
  std::vector<std::size_t> sorted;
  for (std::size_t n = 0; n < points.size(); ++n) {
    const OrderPoint& p = points[n];
    if (!p.failed && p.error > rule.smallest && p.error > 0 && p.error <= rule.largest) sorted.push_back(n);
  }
  std::sort(sorted.begin(), sorted.end(), [&](auto a, auto b) { return points[a].step < points[b].step; });
  OrderFit fit;
  fit.used = straight(points, sorted, rule.spread);
  if (fit.used.size() < 3) return {};
  std::vector<double> x, y;
  for (std::size_t n : fit.used) {
    x.push_back(std::log(points[n].step));
    y.push_back(std::log(points[n].error));
  }
  const StraightLine line = least_squares(x, y);
  const double half = student_t(0.975, static_cast<int>(x.size()) - 2) * line.slope_error;
  fit.order = line.slope;
  fit.low = line.slope - half;
  fit.high = line.slope + half;
  fit.constant = std::exp(line.at_zero);
  return fit;
}

StraightLine least_squares(const std::vector<double>& x, const std::vector<double>& y) {
  CHECK(x.size() == y.size() && x.size() >= 3);
  const auto count = static_cast<double>(x.size());
  double mean_x = 0, mean_y = 0;
  for (std::size_t n = 0; n < x.size(); ++n) {
    mean_x += x[n] / count;
    mean_y += y[n] / count;
  }
  double xx = 0, xy = 0, rest = 0;
  for (std::size_t n = 0; n < x.size(); ++n) {
    xx += (x[n] - mean_x) * (x[n] - mean_x);
    xy += (x[n] - mean_x) * (y[n] - mean_y);
  }
  CHECK(xx > 0);
  StraightLine line;
  line.slope = xy / xx;
  line.at_zero = mean_y - line.slope * mean_x;
  for (std::size_t n = 0; n < x.size(); ++n) {
    const double r = y[n] - line.at_zero - line.slope * x[n];
    rest += r * r;
  }
  line.slope_error = std::sqrt(rest / (count - 2) / xx);
  return line;
}

double student_t(double probability, int freedom) {
  CHECK(freedom >= 1 && probability >= 0.5 && probability < 1);
  const double inside = 2 * probability - 1;
  double low = 0, high = 1;
  while (within(high, freedom) < inside) high *= 2;
  for (int n = 0; n < 100; ++n) {
    const double middle = 0.5 * (low + high);
    (within(middle, freedom) < inside ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

} // namespace rend
