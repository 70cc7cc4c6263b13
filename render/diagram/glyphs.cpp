#include "render/diagram/glyphs.h"

#include "sim/base/check.h"
#include "sim/base/error.h"

#ifdef REND_HUD
#include "render/draw/hud_font.h"

#define STB_TRUETYPE_IMPLEMENTATION
#define STBTT_STATIC
#include <imstb_truetype.h>
#endif

namespace rend {

#ifdef REND_HUD
namespace {

class Font {
public:
  explicit Font(std::span<const std::uint8_t> file) {
    CHECK(stbtt_InitFont(&info_, file.data(), stbtt_GetFontOffsetForIndex(file.data(), 0)) != 0);
  }

  double advance(int glyph, double size) const {
    int advance = 0, bearing = 0;
    stbtt_GetGlyphHMetrics(&info_, glyph, &advance, &bearing);
    return advance * scale(size);
  }
  int glyph(char32_t letter) const { return stbtt_FindGlyphIndex(&info_, static_cast<int>(letter)); }

  Contours outline(int glyph, double size, Spot at) const {
    stbtt_vertex* parts = nullptr;
    const int count = stbtt_GetGlyphShape(&info_, glyph, &parts);
    Contours out;
    const double s = scale(size);
    const auto place = [&](double x, double y) { return Spot{at.x + s * x, at.y - s * y}; };
    for (int n = 0; n < count; ++n) {
      const stbtt_vertex& part = parts[n];
      const Spot end = place(part.x, part.y);
      if (part.type == STBTT_vmove) out.emplace_back();
      if (out.empty()) continue;
      if (part.type == STBTT_vcurve)
        curve(out.back(), place(part.cx, part.cy), place(part.cx, part.cy), end, true);
      else if (part.type == STBTT_vcubic)
        curve(out.back(), place(part.cx, part.cy), place(part.cx1, part.cy1), end, false);
      else
        out.back().push_back(end);
    }
    stbtt_FreeShape(&info_, parts);
    return out;
  }

private:
  double scale(double size) const {
    return static_cast<double>(stbtt_ScaleForMappingEmToPixels(&info_, 1)) * size;
  }

  // A Bezier curve from the last spot: of degree two, or three.
  static void curve(std::vector<Spot>& contour, Spot b, Spot c, Spot d, bool quadratic) {
    constexpr int pieces = 6;
    const Spot a = contour.back();
    for (int n = 1; n <= pieces; ++n) {
      const double t = static_cast<double>(n) / pieces, u = 1 - t;
      contour.push_back(quadratic ? u * u * a + 2 * u * t * b + t * t * d
                                  : u * u * u * a + 3 * u * u * t * b + 3 * u * t * t * c + t * t * t * d);
    }
  }

  stbtt_fontinfo info_{};
};

const Font& font(bool bold) {
  static const Font regular(hud_font()), strong(hud_font_bold());
  return bold ? strong : regular;
}

// Of valid UTF-8.
std::vector<char32_t> letters_of(const std::string& text) {
  std::vector<char32_t> out;
  for (char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xc0u) == 0x80u) {
      if (!out.empty()) out.back() = out.back() << 6 | (byte & 0x3fu);
    } else {
      out.push_back(byte < 0x80u ? byte : byte < 0xe0u ? byte & 0x1fu : byte < 0xf0u ? byte & 0xfu : byte & 7u);
    }
  }
  return out;
}

} // namespace

void require_glyphs() {}

std::vector<Contours> glyphs_of(const std::string& text, double size, bool bold, Spot at) {
  std::vector<Contours> out;
  for (char32_t letter : letters_of(text)) {
    const int glyph = font(bold).glyph(letter);
    out.push_back(font(bold).outline(glyph, size, at));
    at.x += font(bold).advance(glyph, size);
  }
  return out;
}

double width_of_glyphs(const std::string& text, double size, bool bold) {
  double width = 0;
  for (char32_t letter : letters_of(text)) width += font(bold).advance(font(bold).glyph(letter), size);
  return width;
}

#else

void require_glyphs() {
  throw UserError(Exit::Usage, {}, "this rend was built without the font that pictures of rules need",
                  "build it with -DREND_HUD=ON, or let the name end in .svg");
}
std::vector<Contours> glyphs_of(const std::string&, double, bool, Spot) {
  return {};
}
double width_of_glyphs(const std::string&, double, bool) {
  return 0;
}

#endif

} // namespace rend
