// Masks in tolerance files: only files in the same folder or below are allowed.
#include "render/files/png.h"
#include "tests/render/commands/program_run.h"
#include "tests/render/needs.h"
#include "tests/render/pictures.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace rend::diff_mask_test {
namespace {

using program::Outcome;
using program::TestFolder;
using testing::HasSubstr;
namespace fs = std::filesystem;

class DiffMask : public testing::Test {
protected:
  // Pictures that differ everywhere, and masks that exclude every pixel.
  void SetUp() override {
    NEEDS_PNG;
    for (const char* folder : {"a", "b", "t/masks", "elsewhere"}) fs::create_directories(place.path() / folder);
    write_png(place.path() / "a/one.png", test::pattern(40, 30, 3, 0));
    write_png(place.path() / "b/one.png", test::pattern(40, 30, 3, 1));
    Image mask(40, 30, 3);
    std::fill(mask.pixels.begin(), mask.pixels.end(), std::uint8_t{0});
    for (const char* name : {"m.png", "t/masks/m.png", "elsewhere/m.png"}) write_png(place.path() / name, mask);
    fs::create_symlink("masks", place.path() / "t/inside");
    fs::create_symlink("../elsewhere", place.path() / "t/outside");
    fs::create_symlink("../m.png", place.path() / "t/m.png");
    fs::create_symlink("circle", place.path() / "t/circle");
  }
  Outcome with(const std::string& name, const std::string& element, const std::string& options = "") const {
    place.write("t/t.xml", fmt::format("<tolerances>\n  <{} mask=\"{}\"/>\n</tolerances>", element, name));
    return place.rend("diff a b -t t/t.xml " + options);
  }

  const TestFolder place;
};

TEST_F(DiffMask, lies_in_the_folder_of_the_tolerances_or_below) {
  EXPECT_EQ(with("masks/m.png", "default").code, 0);
  EXPECT_EQ(with("inside/m.png", "default").code, 0);
  EXPECT_EQ(with("", "default").code, 1); // none
  const std::string absolute = (place.path() / "t/masks/m.png").string();
  for (const std::string name : {"../m.png", "masks/../../m.png", "m.png", "outside/m.png", "circle/m.png",
                                 "/dev/zero", absolute.c_str()}) {
    for (const char* element : {"default", "case name=\"two.png\""}) { // whether or not it would be used
      const Outcome outcome = with(name, element);
      EXPECT_EQ(outcome.code, 2) << name;
      EXPECT_THAT(outcome.err, HasSubstr("t/t.xml:2:")) << name;
      EXPECT_THAT(outcome.err, HasSubstr("is outside of the tolerances' folder")) << name;
    }
  }
}

TEST_F(DiffMask, may_lie_anywhere_where_the_command_line_says_so) {
  for (const char* name : {"../m.png", "outside/m.png", "m.png"})
    EXPECT_EQ(with(name, "default", "--allow-path").code, 0) << name;
  EXPECT_EQ(place.rend("diff a b --mask m.png").code, 0);
}

} // namespace
} // namespace rend::diff_mask_test
