// Letters: their holes by what everybody knows of them, their areas against the pixels that they cover, and
// meshes of them by Euler's formula.
#include "sim/mesh/text_outline.h"

#include "sim/font/font.h"
#include "sim/mesh/outline_mesh.h"
#include "sim/topology/count.h"

#define STB_TRUETYPE_IMPLEMENTATION
#define STBTT_STATIC
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stb/stb_truetype.h>

#include <map>
#include <numeric>

namespace rend::text_outline_test {
namespace {

using testing::HasSubstr;

const std::string capitals_and_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
constexpr int pixels_an_em = 400;

int holes_of(char letter) {
  static const std::map<char, int> holes{{'A', 1}, {'B', 2}, {'D', 1}, {'O', 1}, {'P', 1}, {'Q', 1},
                                         {'R', 1}, {'0', 1}, {'4', 1}, {'6', 1}, {'8', 2}, {'9', 1}};
  const auto found = holes.find(letter);
  return found == holes.end() ? 0 : found->second;
}

// [em²], of the pixels that stb_truetype fills by the winding of the curves.
double area_of_pixels(char letter) {
  const std::uint8_t* const file = font_file(FontWeight::SemiBold).data();
  stbtt_fontinfo font{};
  EXPECT_NE(stbtt_InitFont(&font, file, stbtt_GetFontOffsetForIndex(file, 0)), 0);
  const float scale = stbtt_ScaleForMappingEmToPixels(&font, pixels_an_em);
  int width = 0, height = 0;
  unsigned char* const pixels =
      stbtt_GetCodepointBitmap(&font, scale, scale, letter, &width, &height, nullptr, nullptr);
  const double sum = std::accumulate(pixels, pixels + width * height, 0.0);
  stbtt_FreeBitmap(pixels, nullptr);
  return sum / 255 / (pixels_an_em * pixels_an_em);
}

class TextOutlines : public testing::Test {
protected:
  void SetUp() override {
    if (!has_font()) GTEST_SKIP() << "built without the font";
  }
};

TEST_F(TextOutlines, cover_what_the_pixels_of_their_letters_do) {
  for (const char letter : capitals_and_digits + "abcdefghklmnopqrstuvwxyz") {
    const TextOutline text = outline_of_text(std::string(1, letter));
    EXPECT_EQ(text.letters, 1);
    const double area = area_of_pixels(letter);
    EXPECT_GT(area, 0.03);
    EXPECT_NEAR(text.outline.area(), area, 0.01 * area) << letter;
  }
}

TEST_F(TextOutlines, of_capitals_and_digits_are_connected_regions_with_the_holes_of_their_letters) {
  for (const char letter : capitals_and_digits) {
    SCOPED_TRACE(letter);
    const Outline outline = fitted(outline_of_text(std::string(1, letter)).outline, 1);
    EXPECT_EQ(static_cast<int>(outline.rings.size()), 1 + holes_of(letter));
    const PolygonMesh mesh = triangles_within(outline, 0.03);
    EXPECT_EQ(parts_of(mesh), 1);
    EXPECT_NEAR(area_of(mesh), outline.area(), 0.03 * outline.area());
    const CellCounts counts = count_cells(sheet_from(mesh)->map());
    EXPECT_EQ(counts.fragments, 1u);
    EXPECT_EQ(static_cast<int>(counts.vertices) - static_cast<int>(counts.edges) +
                  static_cast<int>(counts.faces),
              1 - holes_of(letter));
  }
}

TEST_F(TextOutlines, of_several_letters_stand_side_by_side) {
  const TextOutline one = outline_of_text("H"), two = outline_of_text("HH"), word = outline_of_text("RE ND");
  EXPECT_EQ(two.letters, 2);
  EXPECT_EQ(word.letters, 4);
  EXPECT_NEAR(two.outline.area(), 2 * one.outline.area(), 5e-3 * one.outline.area());
  const double step = two.outline.box().sizes().x() - one.outline.box().sizes().x();
  EXPECT_GT(step, one.outline.box().sizes().x());    // they do not touch
  EXPECT_NEAR(one.outline.box().min().y(), 0, 1e-3); // on the line
  EXPECT_GT(word.outline.box().max().y(), 0.6);
  EXPECT_EQ(parts_of(triangles_within(fitted(word.outline, 1), 0.01)), 4);
}

TEST_F(TextOutlines, are_refused_where_a_letter_is_not_connected_or_not_there) {
  const auto fault = [](const std::string& text) -> std::string {
    try {
      static_cast<void>(outline_of_text(text));
    } catch (const TextFault& caught) {
      return caught.what();
    }
    return "";
  };
  EXPECT_THAT(fault("Rind"), HasSubstr("the letter 'i' consists of 2 parts"));
  EXPECT_THAT(fault("M\xC3\x9CHE"), HasSubstr("the letter '\xC3\x9C' consists of 3 parts"));
  EXPECT_THAT(fault("A\xE4\xB8\x80"), HasSubstr("has no letter '\xE4\xB8\x80'"));
  EXPECT_THAT(fault("  "), HasSubstr("no letter"));
  EXPECT_EQ(fault("rend"), "");
}

} // namespace
} // namespace rend::text_outline_test
