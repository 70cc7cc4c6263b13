#include "render/diagram/glyphs.h"

#include "sim/base/error.h"
#include "sim/font/font.h"

namespace rend {
namespace {

FontWeight weight_of(bool bold) {
  return bold ? FontWeight::SemiBold : FontWeight::Regular;
}

Contours outline(FontWeight weight, int glyph, double size, Spot at) {
  const double s = em_per_unit(weight) * size;
  const auto place = [&](const Eigen::Vector2d& p) { return Spot{at.x + s * p.x(), at.y - s * p.y()}; };
  constexpr int pieces = 6; // of a curve
  Contours out;
  for (const GlyphContour& contour : contours_of(weight, glyph)) {
    std::vector<Spot>& spots = out.emplace_back();
    for (const GlyphCurve& curve : contour) {
      const Spot a = place(curve[0]), b = place(curve[1]), c = place(curve[2]), d = place(curve[3]);
      if (spots.empty()) spots.push_back(a);
      const bool straight = curve[0] == curve[1] && curve[2] == curve[3];
      if (straight) spots.push_back(d);
      for (int n = 1; n <= pieces && !straight; ++n) {
        const double t = static_cast<double>(n) / pieces, u = 1 - t;
        spots.push_back(u * u * u * a + 3 * u * u * t * b + 3 * u * t * t * c + t * t * t * d);
      }
    }
  }
  return out;
}

} // namespace

void require_glyphs() {
  if (has_font()) return;
  throw UserError(Exit::Usage, {}, "this rend was built without the font that pictures of rules need",
                  "build it with -DREND_FONT=ON, or let the name end in .svg");
}

std::vector<Contours> glyphs_of(const std::string& text, double size, bool bold, Spot at) {
  std::vector<Contours> out;
  if (!has_font()) return out;
  const FontWeight weight = weight_of(bold);
  for (char32_t letter : letters_of(text)) {
    const int glyph = glyph_of(weight, letter);
    out.push_back(outline(weight, glyph, size, at));
    at.x += advance_of(weight, glyph) * (em_per_unit(weight) * size);
  }
  return out;
}

double width_of_glyphs(const std::string& text, double size, bool bold) {
  double width = 0;
  if (!has_font()) return width;
  const FontWeight weight = weight_of(bold);
  for (char32_t letter : letters_of(text))
    width += advance_of(weight, glyph_of(weight, letter)) * (em_per_unit(weight) * size);
  return width;
}

} // namespace rend
