#include "sim/base/math.h"

#include "sim/base/arc_tangent.h"

#include <cmath>

namespace rend {
namespace {

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

// The sine of angle + 90 · quarters degrees. The quarters are counted, as adding them to the angle would round
// it.
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
  return arc_tangent_of(y, x);
}

double sine_of_degrees(double angle) {
  return sine_of_turned(angle, 0);
}
double cosine_of_degrees(double angle) {
  return sine_of_turned(angle, 1);
}

} // namespace rend
