// SSIM: structural similarity of two pictures, 1 if they are equal.
//
//   SSIM(a, b) = (2 μa μb + C1)(2 σab + C2) / ((μa² + μb² + C1)(σa² + σb² + C2)),
//   C1 = (0.01·255)², C2 = (0.03·255)²
//
// over uniformly weighted windows of 7 × 7 pixels, with sample (co)variances (n − 1); the mean over all windows
// that lie within the picture, and over red, green and blue. These are the defaults of scikit-image's
// structural_similarity (with channel_axis), and give the same values. Wang, Bovik, Sheikh, Simoncelli: Image
// Quality Assessment: From Error Visibility to Structural Similarity. IEEE Transactions on Image Processing 13
// (2004), eq. 13.
#pragma once

#include "render/compare/picture.h"

namespace rend {

// Opaque pictures of one size (CHECK). With a mask: over the windows whose centre is unmasked; 1 if there is
// none. A side of less than 7 pixels is spanned by the window.
double ssim_of(const Picture& a, const Picture& b, const PixelMask& mask, int threads);

} // namespace rend
