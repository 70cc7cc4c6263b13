// The font that is embedded in the program at build time: Inter (SIL Open Font License 1.1), and the outlines
// of its glyphs, read by stb_truetype. Text over pictures, letters in drawings and letters as shapes of bodies
// are all of this one font, so that they need no file where the program runs.
//
// Lengths are in the font's units, y up; the baseline is y = 0, and a glyph begins at x = 0.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rend {

// False: rend was built with REND_FONT=OFF. Then nothing else of this header may be called.
bool has_font();

enum class FontWeight { Regular, SemiBold };

std::span<const std::uint8_t> font_file(FontWeight weight); // OpenType

// Control points of a cubic Bézier curve. A line has each of its ends twice.
using GlyphCurve = std::array<Eigen::Vector2d, 4>;
using GlyphContour = std::vector<GlyphCurve>; // closed: each begins where the one before ends

double em_per_unit(FontWeight weight);            // of the font
int glyph_of(FontWeight weight, char32_t letter); // 0: the font has none
double advance_of(FontWeight weight, int glyph);  // to where the next glyph begins
std::vector<GlyphContour> contours_of(FontWeight weight, int glyph);

// The characters of UTF-8 text, which is valid.
std::vector<char32_t> letters_of(const std::string& text);

} // namespace rend
