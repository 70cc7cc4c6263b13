#include "sim/base/math.h"

#include <cmath>
#include <limits>

namespace rend {
namespace {

// atan of t in [0, 1]: atan t = atan c + atan((t − c)/(1 + tc)) with c the nearest quarter, then the series of
// atan r for |r| ≤ 1/8, whose next term is below 1e-18.
double arc_tangent_of_ratio(double t) {
  static constexpr double table[5] = {0.0, 0.24497866312686415, 0.46364760900080609, 0.64350110879328437,
                                      0.78539816339744828}; // atan(0), atan(1/4), ...
  const int quarter = static_cast<int>(t * 4 + 0.5);
  const double c = quarter * 0.25;
  const double r = (t - c) / (1 + t * c);
  const double s = r * r;
  const double series =
      1 - s * (1.0 / 3 -
               s * (1.0 / 5 -
                    s * (1.0 / 7 - s * (1.0 / 9 - s * (1.0 / 11 - s * (1.0 / 13 - s * (1.0 / 15 - s / 17)))))));
  return table[quarter] + r * series;
}

// sin and cos of an angle in [−45, 45] degrees by their series.
double small_sine(double degrees) {
  const double x = degrees * (pi / 180), s = x * x;
  double sum = 0;
  for (int n = 19; n >= 3; n -= 2) sum = (1 + sum) * (-s / (n * (n - 1.0)));
  return x * (1 + sum);
}
double small_cosine(double degrees) {
  const double x = degrees * (pi / 180), s = x * x;
  double sum = 0;
  for (int n = 20; n >= 2; n -= 2) sum = (1 + sum) * (-s / (n * (n - 1.0)));
  return 1 + sum;
}

// The sine of an angle that is `quarters` right angles further. They are counted rather than added to the
// angle, which would round it.
double sine_of_turned(double angle, int quarters) {
  const double turn = std::remainder(angle, 360.0); // exact
  const double quadrant = std::nearbyint(turn / 90);
  const double rest = turn - 90 * quadrant;
  switch ((static_cast<int>(quadrant) + quarters) & 3) {
  case 0:
    return small_sine(rest);
  case 1:
    return small_cosine(rest);
  case 2:
    return -small_sine(rest);
  default:
    return -small_cosine(rest);
  }
}

} // namespace

double arc_tangent(double y, double x) {
  const double a = std::abs(x), b = std::abs(y);
  if (a == 0 && b == 0) return 0;
  if (!(a + b <= std::numeric_limits<double>::max())) return std::numeric_limits<double>::quiet_NaN();
  double angle = b <= a ? arc_tangent_of_ratio(b / a) : pi / 2 - arc_tangent_of_ratio(a / b);
  if (x < 0) angle = pi - angle;
  return y < 0 ? -angle : angle;
}

double sine_of_degrees(double angle) {
  return sine_of_turned(angle, 0);
}
double cosine_of_degrees(double angle) {
  return sine_of_turned(angle, 1);
}

} // namespace rend
