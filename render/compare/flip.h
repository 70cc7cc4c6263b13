// FLIP: the difference that a viewer perceives who flips between two pictures on the same screen.
//
// Colour pipeline: sRGB → YCxCz; each channel is blurred as the eye blurs it (sums of Gaussians: contrast
// sensitivity); → linear RGB, clamped → L*a*b*, chroma scaled by 0.01 L (Hunt); then the distance HyAB = |ΔL| +
// √(Δa² + Δb²), to the power 0.7, mapped to 0 … 1 (0.4 of the largest becomes 0.95). Feature pipeline: edges
// and points of the luminance, by first and second derivatives of a Gaussian as wide as the smallest detail
// that the eye resolves; f = √(max(|Δ edges|, |Δ points|) / √2).
//
//   FLIP = colour ^ (1 − f), of every pixel: 0 where no difference is visible, 1 for black against white
//
// Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild: FLIP: A Difference Evaluator for
// Alternating Images. Proc. ACM Comput. Graph. Interact. Tech. 3 (2020); LDR, with the constants of the
// authors' program. All filters are separable, or sums of separable ones: they run along rows, then along
// columns.
#pragma once

#include "render/compare/picture.h"

namespace rend {

// 3840 pixels on a screen of 0.7 m width, seen from 0.7 m: the authors' default.
constexpr double pixels_per_degree = 67.0206;

// The map, height x width. Opaque pictures of one size (CHECK); symmetric in its arguments. The same on any
// number of threads.
Levels flip_map(const Picture& a, const Picture& b, int threads);

} // namespace rend
