// The arc tangent of one double or of four at once. Both are instances of one template and give identical bits.
//
//   atan t = atan c + atan((t − c)/(1 + tc))   with t in [0, 1] and c the nearest multiple of 1/4,
//
// then the Taylor series of atan r for |r| ≤ 1/8, whose first neglected term is below 1e-18. Cases are selected
// without branches.
#pragma once

#include "sim/base/math.h"
#include "sim/base/simd.h"

#include <limits>

namespace rend {

// The arc tangent of t in [0, 1]. Number: double or Double4.
template <class Number> REND_INLINE Number arc_tangent_of_ratio(const Number& t) {
  constexpr double table[5] = {0.0, 0.24497866312686415, 0.46364760900080609, 0.64350110879328437,
                               0.78539816339744828}; // atan(0), atan(1/4), ...
  const Number quarters = t * 4.0 + 0.5, none{};
  Number c = none, start = none;
  for (int n = 1; n <= 4; ++n) {
    c = quarters >= none + n ? none + 0.25 * n : c;
    start = quarters >= none + n ? none + table[n] : start;
  }
  const Number r = (t - c) / (1.0 + t * c);
  const Number s = r * r;
  const Number q = s * s; // powers in pairs: a shorter dependency chain
  const Number low = (1.0 / 3 - s * (1.0 / 5)) + q * (1.0 / 7 - s * (1.0 / 9));
  const Number high = (1.0 / 11 - s * (1.0 / 13)) + q * (1.0 / 15 - s * (1.0 / 17));
  const Number series = 1.0 - s * (low + q * q * high);
  return start + r * series;
}

// The same as arc_tangent(y, x) of math.h.
template <class Number> REND_INLINE Number arc_tangent_of(const Number& y, const Number& x) {
  const Number none{};
  const Number a = x < 0.0 ? -x : x, b = y < 0.0 ? -y : y;
  const Number small = b <= a ? b : a, large = b <= a ? a : b;
  Number angle = arc_tangent_of_ratio<Number>(small / large);
  angle = b <= a ? angle : pi / 2 - angle;
  angle = x < 0.0 ? pi - angle : angle;
  angle = y < 0.0 ? -angle : angle;
  angle = large == 0.0 ? none : angle;
  return a + b <= none + std::numeric_limits<double>::max() ? angle
                                                            : none + std::numeric_limits<double>::quiet_NaN();
}

} // namespace rend
