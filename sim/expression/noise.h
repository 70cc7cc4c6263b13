// Value noise: an irregular, smooth function of a position, the same on every processor.
//
//   noise(p) = Σ over the 8 corners c of the unit cube around p of h(c) Π_k w_k
//   w_k = s(t_k) at the upper corners, 1 − s(t_k) at the lower ones
//   t = p − ⌊p⌋,   s(t) = t²(3 − 2t)
//
// h(c) in [0, 1) is a hash of the whole numbers c and of the seed (XXH3). Since s' is 0 at both ends, the
// gradient is continuous: the function is C1. It varies over a length of 1; noise(p/l) varies over l. (The
// cubic weights are those of K. Perlin, An image synthesizer, SIGGRAPH 1985; his noise of gradients is 0 on the
// lattice, which shows as a pattern where a mesh is regular.)
#pragma once

#include <array>

namespace rend {

// In [0, 1). `position` and `seed` are finite; another seed gives other values, whatever its size.
double noise(const std::array<double, 3>& position, double seed = 0);
std::array<double, 3> noise_gradient(const std::array<double, 3>& position, double seed = 0);

} // namespace rend
