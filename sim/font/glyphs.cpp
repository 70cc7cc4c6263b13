#include "sim/font/font.h"

#include "sim/base/check.h"

#ifdef REND_FONT
#define STB_TRUETYPE_IMPLEMENTATION
#define STBTT_STATIC
#include <stb/stb_truetype.h>
#endif

namespace rend {

#ifdef REND_FONT
namespace {

const stbtt_fontinfo& font_of(FontWeight weight) {
  const auto opened = [](FontWeight of) {
    const std::uint8_t* const file = font_file(of).data();
    stbtt_fontinfo info{};
    CHECK(stbtt_InitFont(&info, file, stbtt_GetFontOffsetForIndex(file, 0)) != 0);
    return info;
  };
  static const stbtt_fontinfo regular = opened(FontWeight::Regular), bold = opened(FontWeight::SemiBold);
  return weight == FontWeight::SemiBold ? bold : regular;
}

// A curve of degree two or three, or a line.
GlyphCurve curve_of(const stbtt_vertex& part, const Eigen::Vector2d& from) {
  const Eigen::Vector2d to(part.x, part.y), one(part.cx, part.cy), two(part.cx1, part.cy1);
  if (part.type == STBTT_vcubic) return {from, one, two, to};
  if (part.type == STBTT_vcurve) return {from, (from + 2 * one) / 3, (to + 2 * one) / 3, to};
  return {from, from, to, to};
}

} // namespace

bool has_font() {
  return true;
}

double em_per_unit(FontWeight weight) {
  return static_cast<double>(stbtt_ScaleForMappingEmToPixels(&font_of(weight), 1));
}

int glyph_of(FontWeight weight, char32_t letter) {
  return stbtt_FindGlyphIndex(&font_of(weight), static_cast<int>(letter));
}

double advance_of(FontWeight weight, int glyph) {
  int advance = 0, bearing = 0;
  stbtt_GetGlyphHMetrics(&font_of(weight), glyph, &advance, &bearing);
  return advance;
}

std::vector<GlyphContour> contours_of(FontWeight weight, int glyph) {
  stbtt_vertex* parts = nullptr;
  const int count = stbtt_GetGlyphShape(&font_of(weight), glyph, &parts);
  std::vector<GlyphContour> contours;
  Eigen::Vector2d here = Eigen::Vector2d::Zero();
  for (int n = 0; n < count; ++n) {
    const stbtt_vertex& part = parts[n];
    if (part.type == STBTT_vmove)
      contours.emplace_back();
    else if (!contours.empty())
      contours.back().push_back(curve_of(part, here));
    here = {part.x, part.y};
  }
  stbtt_FreeShape(&font_of(weight), parts);
  return contours;
}

#else

bool has_font() {
  return false;
}
std::span<const std::uint8_t> font_file(FontWeight) {
  CHECK(has_font());
  return {};
}
double em_per_unit(FontWeight) {
  CHECK(has_font());
  return 0;
}
int glyph_of(FontWeight, char32_t) {
  CHECK(has_font());
  return 0;
}
double advance_of(FontWeight, int) {
  CHECK(has_font());
  return 0;
}
std::vector<GlyphContour> contours_of(FontWeight, int) {
  CHECK(has_font());
  return {};
}

#endif

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

} // namespace rend
