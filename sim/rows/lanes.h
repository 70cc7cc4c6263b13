// Four rows at a time: records transposed into lanes of x, y, z and back, and small matrices of lanes.
#pragma once

#include "sim/base/simd.h"
#include "sim/rows/kernels.h"

namespace rend::lanes {

struct Vector {
  Double4 x, y, z; // of four rows
};
REND_INLINE Vector operator+(const Vector& a, const Vector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
REND_INLINE Vector operator-(const Vector& a, const Vector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
REND_INLINE Vector operator*(const Double4& s, const Vector& a) {
  return {s * a.x, s * a.y, s * a.z};
}
REND_INLINE Double4 dot(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
REND_INLINE Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// 3 × Columns, column by column.
template <int Columns> struct Matrix { Vector column[Columns]; };

REND_INLINE Double4 load_four(const double* values) {
  Double4 lanes;
  __builtin_memcpy(&lanes, values, sizeof lanes);
  return lanes;
}

REND_INLINE Vector transposed(Double4 a, Double4 b, Double4 c, Double4 d) {
  const Double4 even1 = __builtin_shuffle(a, b, Long4{0, 4, 2, 6}),
                odd1 = __builtin_shuffle(a, b, Long4{1, 5, 3, 7});
  const Double4 even2 = __builtin_shuffle(c, d, Long4{0, 4, 2, 6}),
                odd2 = __builtin_shuffle(c, d, Long4{1, 5, 3, 7});
  return {__builtin_shuffle(even1, even2, Long4{0, 1, 4, 5}), __builtin_shuffle(odd1, odd2, Long4{0, 1, 4, 5}),
          __builtin_shuffle(even1, even2, Long4{2, 3, 6, 7})};
}

REND_INLINE Vector gather(const Record* records, const std::uint32_t* index) {
  return transposed(load(records[index[0]]), load(records[index[1]]), load(records[index[2]]),
                    load(records[index[3]]));
}

// Adds to four records in the order of rows; records outside [low, high) belong to another part.
template <bool whole>
REND_INLINE void scatter(const KernelArguments& a, const std::uint32_t* index, const Vector& force) {
  const Double4 zero{};
  const Double4 xy02 = __builtin_shuffle(force.x, force.y, Long4{0, 4, 2, 6});
  const Double4 xy13 = __builtin_shuffle(force.x, force.y, Long4{1, 5, 3, 7});
  const Double4 z02 = __builtin_shuffle(force.z, zero, Long4{0, 4, 2, 6});
  const Double4 z13 = __builtin_shuffle(force.z, zero, Long4{1, 5, 3, 7});
  const Double4 row[4] = {
      __builtin_shuffle(xy02, z02, Long4{0, 1, 4, 5}), __builtin_shuffle(xy13, z13, Long4{0, 1, 4, 5}),
      __builtin_shuffle(xy02, z02, Long4{2, 3, 6, 7}), __builtin_shuffle(xy13, z13, Long4{2, 3, 6, 7})};
  for (int r = 0; r < 4; ++r)
    if (whole || (index[r] >= a.low && index[r] < a.high))
      store(a.force[index[r]], load(a.force[index[r]]) + row[r]);
}

} // namespace rend::lanes
