// The colour spaces of FLIP: sRGB, linear RGB, XYZ (D65), YCxCz, L*a*b*.
#pragma once

#include <array>

namespace rend {

using Colour3 = std::array<float, 3>;

float linear_of(float level); // sRGB, 0 to 255 → linear, 0 to 1 (IEC 61966-2-1)
Colour3 ycxcz_of(
    const Colour3& linear); // an opponent space that is linear in XYZ: (116 Y − 16, 500 (X − Y), 200 (Y − Z))
Colour3 linear_of_ycxcz(const Colour3& ycxcz); // clamped to 0 … 1
Colour3 hunt_lab_of(const Colour3& linear);    // L*, and a*, b* times 0.01 L*: dark colours differ less

// |ΔL| + √(Δa² + Δb²). Abasi, Tehran, Fairchild: Distance metrics for very large color differences. Color
// Research & Application 45 (2020).
float hyab(const Colour3& a, const Colour3& b);

} // namespace rend
