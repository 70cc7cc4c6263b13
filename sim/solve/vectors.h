// Sums over vertex slots, and the vector operations of conjugate gradients.
//
// A sum is taken over blocks of a fixed length, and then over the blocks in order: its bytes depend on the size
// alone, never on the number of threads.
#pragma once

#include "sim/base/simd.h"

#include <cstdint>
#include <vector>

namespace rend {

using Records = std::vector<Record>; // one per vertex slot

inline double sum3(Double4 v) {
  return v[0] + v[1] + v[2];
}

// 1 for free coordinates, 0 for constrained ones: bits 0, 1, 2.
inline Double4 free_axes(std::uint8_t held) {
  return Double4{held & 1 ? 0.0 : 1.0, held & 2 ? 0.0 : 1.0, held & 4 ? 0.0 : 1.0, 0.0};
}

double largest_coordinate(const Records& x); // the maximum norm

double dot(int parts, const Records& a, const Records& b);

void add_scaled(int parts, double s, const Records& x, Records& y);    // y += s x
void scale_and_add(int parts, double s, const Records& x, Records& y); // y = x + s y

} // namespace rend
