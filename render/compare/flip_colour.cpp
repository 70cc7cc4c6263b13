#include "render/compare/flip_colour.h"

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

// Linear RGB to XYZ, divided by the D65 white point: rows sum to 1 up to rounding.
constexpr double white_x = 0.950428545, white_z = 1.088900371;
constexpr std::array<std::array<double, 3>, 3> to_xyz{
    {{10135552. / 24577794 / white_x, 8788810. / 24577794 / white_x, 4435075. / 24577794 / white_x},
     {2613072. / 12288897, 8788810. / 12288897, 887015. / 12288897},
     {1425312. / 73733382 / white_z, 8788810. / 73733382 / white_z, 70074185. / 73733382 / white_z}}};

// Its inverse, by cofactors.
constexpr std::array<std::array<double, 3>, 3> inverse(const std::array<std::array<double, 3>, 3>& m) {
  std::array<std::array<double, 3>, 3> out{};
  const auto minor = [&](std::size_t i, std::size_t j) {
    const std::size_t a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
    return m[a][c] * m[b][d] - m[a][d] * m[b][c];
  };
  const double determinant = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) out[j][i] = minor(i, j) / determinant;
  return out;
}
constexpr auto to_rgb = inverse(to_xyz);

Colour3 times(const std::array<std::array<double, 3>, 3>& m, const Colour3& v) {
  Colour3 out{};
  for (std::size_t i = 0; i < 3; ++i)
    out[i] = static_cast<float>(m[i][0]) * v[0] + static_cast<float>(m[i][1]) * v[1] +
             static_cast<float>(m[i][2]) * v[2];
  return out;
}

float lab_curve(float t) {
  constexpr float delta = 6.f / 29;
  return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.f / 29;
}

} // namespace

float linear_of(float level) {
  const double c = static_cast<double>(level) / 255;
  return static_cast<float>(c > 0.04045 ? std::pow((c + 0.055) / 1.055, 2.4) : c / 12.92);
}

Colour3 ycxcz_of(const Colour3& linear) {
  const Colour3 xyz = times(to_xyz, linear);
  return {116 * xyz[1] - 16, 500 * (xyz[0] - xyz[1]), 200 * (xyz[1] - xyz[2])};
}

Colour3 linear_of_ycxcz(const Colour3& ycxcz) {
  const float y = (ycxcz[0] + 16) / 116;
  Colour3 rgb = times(to_rgb, {y + ycxcz[1] / 500, y, y - ycxcz[2] / 200});
  for (float& c : rgb) c = std::clamp(c, 0.f, 1.f);
  return rgb;
}

Colour3 hunt_lab_of(const Colour3& linear) {
  const Colour3 xyz = times(to_xyz, linear);
  const float x = lab_curve(xyz[0]), y = lab_curve(xyz[1]), z = lab_curve(xyz[2]);
  const float l = 116 * y - 16;
  return {l, 0.01f * l * 500 * (x - y), 0.01f * l * 200 * (y - z)};
}

float hyab(const Colour3& a, const Colour3& b) {
  const float da = a[1] - b[1], db = a[2] - b[2];
  return std::abs(a[0] - b[0]) + std::sqrt(da * da + db * db);
}

} // namespace rend
