#include "sim/mesh/text_outline.h"

#include "sim/base/wording.h"
#include "sim/font/font.h"

#include <fmt/format.h>

namespace rend {
namespace {

constexpr FontWeight letter_weight = FontWeight::SemiBold;

// Curves are flattened in the end, all at once, with one tolerance.
std::vector<Curve> at_baseline(const std::vector<GlyphContour>& contours, double from) {
  const double scale = em_per_unit(letter_weight);
  std::vector<Curve> curves;
  for (const GlyphContour& contour : contours) {
    Curve& curve = curves.emplace_back(contour);
    for (Cubic& cubic : curve)
      for (Vec2& point : cubic) point = scale * (point + Vec2(from, 0));
  }
  return curves;
}

std::string utf8_of(const std::string& text, std::size_t letter) { // in quotes
  std::size_t begin = 0;
  const auto continues = [&](std::size_t at) {
    return (static_cast<unsigned char>(text[at]) & 0xc0U) == 0x80U;
  };
  const auto next = [&](std::size_t at) {
    do ++at;
    while (at < text.size() && continues(at));
    return at;
  };
  for (std::size_t n = 0; n < letter; ++n) begin = next(begin);
  return in_quotes(text.substr(begin, next(begin) - begin));
}

} // namespace

TextOutline outline_of_text(const std::string& text) {
  if (!has_font())
    throw TextFault("this rend was built without the font that letters need", "build it with -DREND_FONT=ON");
  const std::vector<char32_t> letters = letters_of(text);
  std::vector<Curve> all;
  double from = 0;
  int count = 0;
  for (std::size_t n = 0; n < letters.size(); ++n) {
    const int glyph = glyph_of(letter_weight, letters[n]);
    if (glyph == 0)
      throw TextFault(fmt::format("the font has no letter {}", utf8_of(text, n)),
                      "it has Latin, Greek and Cyrillic ones, and digits");
    const std::vector<Curve> curves = at_baseline(contours_of(letter_weight, glyph), from);
    if (const int parts = flattened(curves).regions(); parts > 1)
      throw TextFault(fmt::format("the letter {} consists of {} parts", utf8_of(text, n), parts),
                      "each letter has to be one connected part, as all capitals and digits are");
    else
      count += parts;
    all.insert(all.end(), curves.begin(), curves.end());
    from += advance_of(letter_weight, glyph);
  }
  if (count == 0) throw TextFault("the text has no letter", "text=\"A\"");
  return {flattened(all), count};
}

} // namespace rend
