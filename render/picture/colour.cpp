#include "render/picture/colour.h"

#include "sim/base/math.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

constexpr std::array<Colour, 9> viridis{{{68, 1, 84},
                                         {71, 44, 122},
                                         {59, 81, 139},
                                         {44, 113, 142},
                                         {33, 144, 141},
                                         {39, 173, 129},
                                         {92, 200, 99},
                                         {170, 220, 50},
                                         {253, 231, 37}}};

// The last bit of pow may differ between processors; rounding to 8 bits hides that.
std::uint8_t encoded(double linear) {
  const double x = std::clamp(linear, 0.0, 1.0);
  const double s = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255 * s));
}

} // namespace

std::string text_of(const Colour& colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", colour[0], colour[1], colour[2]);
}

std::optional<Colour> colour_called(std::string_view text) {
  if (text.size() != 7 || text[0] != '#') return {};
  Colour colour{};
  for (std::size_t c = 0; c < 3; ++c) {
    const int high = hex_digit(text[1 + 2 * c]), low = hex_digit(text[2 + 2 * c]);
    if (high < 0 || low < 0) return {};
    colour[c] = static_cast<std::uint8_t>(16 * high + low);
  }
  return colour;
}

Colour colour_of(const PresetNode& node, std::string_view attribute) {
  const std::string& text = node.text(attribute);
  const std::optional<Colour> colour = colour_called(text);
  if (!colour)
    node.fail(attribute,
              std::string(attribute) + " of <" + node.name() + "> is " + in_quotes(text) +
                  ", which is not a colour",
              "write a colour as #rrggbb, such as #2a7f8e");
  return *colour;
}

Colour colour_of_share(double share) {
  const double at = std::clamp(share, 0.0, 1.0) * (viridis.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(at), viridis.size() - 2);
  const double t = at - static_cast<double>(below);
  Colour colour{};
  for (std::size_t c = 0; c < 3; ++c)
    colour[c] = static_cast<std::uint8_t>(std::lround((1 - t) * viridis[below][c] + t * viridis[below + 1][c]));
  return colour;
}

Colour colour_of_number(std::size_t number) {
  constexpr double turn = 360 * 0.6180339887498949; // [degrees]
  const double hue = 200 + turn * static_cast<double>(number % 100000);
  const double light = number % 2 == 0 ? 0.70 : 0.60, chroma = 0.10;
  const double a = chroma * cosine_of_degrees(hue), b = chroma * sine_of_degrees(hue);
  const auto cube = [](double x) { return x * x * x; };
  const double l = cube(light + 0.3963377774 * a + 0.2158037573 * b);
  const double m = cube(light - 0.1055613458 * a - 0.0638541728 * b);
  const double s = cube(light - 0.0894841775 * a - 1.2914855480 * b);
  return {encoded(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          encoded(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          encoded(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

double rounded_up(double value) {
  if (!(value > 0)) return 0;
  double power = 1;
  while (power > value) power /= 10;
  while (power * 10 < value) power *= 10;
  for (double factor : {1.0, 2.0, 5.0})
    if (power * factor >= value) return power * factor;
  return power * 10;
}

} // namespace rend
