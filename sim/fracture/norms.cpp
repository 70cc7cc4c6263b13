#include "sim/fracture/norms.h"

#include "sim/base/simd.h"

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

REND_INLINE double norms_of(const Record* force, std::size_t count, double* norm) {
  const Double4 axes{1, 1, 1, 0}; // the fourth lane may hold other data
  Double4 largest{};
  std::size_t v = 0;
  for (; v + 4 <= count; v += 4) {
    const Double4 a = axes * load(force[v]), b = axes * load(force[v + 1]), c = axes * load(force[v + 2]),
                  d = axes * load(force[v + 3]);
    const Double4 n = square_root(sums_of(a * a, b * b, c * c, d * d));
    __builtin_memcpy(norm + v, &n, sizeof n);
    largest = n > largest ? n : largest;
  }
  for (; v < count; ++v) {
    const Record& f = force[v];
    norm[v] = std::sqrt(f.x * f.x + f.y * f.y + f.z * f.z);
    largest[0] = std::max(largest[0], norm[v]);
  }
  return std::max(std::max(largest[0], largest[1]), std::max(largest[2], largest[3]));
}

} // namespace

double norms(const Record* force, std::size_t count, double* norm) {
  return at_width<norms_of>(force, count, norm);
}

} // namespace rend
