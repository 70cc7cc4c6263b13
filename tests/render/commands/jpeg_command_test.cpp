// JPEG files as textures: what is refused and how, and that they look the same on every machine.
#include "render/files/png.h"
#include "tests/render/commands/program_run.h"
#include "tests/render/jpeg_files.h"
#include "tests/render/needs.h"
#include "tests/render/pictures.h"

#include <gmock/gmock.h>

namespace rend::jpeg_command_test {
namespace {

using namespace test;
using program::Outcome;
using program::TestFolder;
using testing::HasSubstr;

// The sheet fills the picture, so that each texel of 48 x 48 covers several pixels.
const char* preset = R"(<scene name="s"><body><sheet cells="1 1" size="1 1"/><place rotate="90 0 0"/>
<mass total="0.1"/><springs><stretch k="60"/></springs>
<look texture="p.jpg" edges="no"/></body><time step="1e-2" duration="0.1"/>
<camera eye="0.5 -2 0.5" target="0.5 0 0.5" fov="26"/><image size="160 160" fps="10"/></scene>)";

TEST(JpegTexture, has_the_same_pixels_without_the_vector_code_of_the_library) {
  NEEDS_PNG;
  NEEDS_JPEG;
  const TestFolder place;
  place.write("s.xml", preset);
  Image noise(48, 48);
  std::mt19937 random(5);
  for (std::uint8_t& byte : noise.pixels) byte = static_cast<std::uint8_t>(random() >> 24);
  const JpegKind kinds[] = {{.quality = 70},
                            {.quality = 70, .across = 2, .down = 1},
                            {.quality = 70, .across = 2, .down = 2},
                            {.quality = 70, .across = 1, .down = 2},
                            {.quality = 40, .progressive = true, .across = 2, .down = 2},
                            {.quality = 70, .colours = JpegColours::Grey},
                            {.quality = 70, .colours = JpegColours::Rgb}};
  std::vector<Image> pictures;
  for (const JpegKind& kind : kinds) {
    place.write("p.jpg", jpeg_file(noise, kind));
    const auto rendered = [&](const std::string& environment) {
      const Outcome outcome =
          place.shell(environment + " " + rend_program + " render s.xml -q -o out --frames 0");
      EXPECT_EQ(outcome.code, 0) << outcome.err;
      return read_png(place.path() / "out/00000.png");
    };
    pictures.push_back(rendered("JSIMD_FORCENONE=1"));
    EXPECT_EQ(rendered("JSIMD_FORCENONE=0"), pictures.back());
  }
  for (std::size_t n = 1; n < pictures.size(); ++n)
    EXPECT_GT(largest_difference(pictures[n], pictures[n - 1]), 3) << n << ": the picture is not to be seen";
}

TEST(JpegTexture, that_is_damaged_is_refused_at_the_attribute) {
  NEEDS_PNG;
  NEEDS_JPEG;
  const TestFolder place;
  place.write("s.xml", preset);
  const std::string good = jpeg_file(pattern(24, 16));
  const auto refused = [&](const std::string& file) {
    place.write("p.jpg", file);
    const Outcome outcome = place.rend("run s.xml -q");
    EXPECT_EQ(outcome.code, 65);
    EXPECT_EQ(outcome.err.rfind("rend: error: s.xml:3:16: ", 0), 0U) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("hint: "));
    return outcome.err;
  };
  EXPECT_THAT(refused(good.substr(0, good.size() / 2)),
              HasSubstr("save the picture again, as a complete PNG or JPEG file"));
  EXPECT_THAT(refused(jpeg_claiming(good, 4097, 16)), HasSubstr("at most 4096 x 4096 are allowed"));
  EXPECT_THAT(refused(jpeg_file(pattern(24, 16, 4), {.colours = JpegColours::Cmyk})), HasSubstr("(CMYK)"));
  place.write("p.jpg", good);
  EXPECT_EQ(place.rend("run s.xml -q").code, 0);
}

TEST(JpegTexture, is_refused_by_a_build_without_it_that_says_so) {
  if (jpeg_available()) GTEST_SKIP() << "built with JPEG";
  const TestFolder place;
  place.write("s.xml", preset);
  place.write("p.jpg", "\xff\xd8\xff\xe0 and so on");
  const Outcome outcome = place.rend("run s.xml -q");
  EXPECT_EQ(outcome.code, 64);
  EXPECT_THAT(outcome.err, HasSubstr("built without JPEG"));
  EXPECT_THAT(outcome.err, HasSubstr("-DREND_JPEG=ON"));
}

} // namespace
} // namespace rend::jpeg_command_test
