#include "render/help/help.h"

#include "tests/render/help/small_table.h"

#include <gtest/gtest.h>
#include <sstream>

namespace rend::help_test {
namespace {

using small_table::scene;

TEST(Help, ShowsAnElementWithItsAttributes) {
  EXPECT_EQ(help_preset(scene, "stretch", false), "scene.body.springs.stretch  (at most one)\n"
                                                  "  Springs along edges.\n"
                                                  "  Attributes:\n"
                                                  "    k         stiffness\n"
                                                  "              a number above 0 [N/m]; required\n"
                                                  "    damping   damping\n"
                                                  "              a number of at least 0 [N·s/m]; default 0\n");
}

TEST(Help, ShowsWhereASharedElementMayStand) {
  const std::string page = help_preset(scene, "look", false);
  EXPECT_EQ(page.find("scene.body.look  (at most one)\nscene.map.look  (exactly one)\n"), 0U) << page;
}

TEST(Help, TakesNamesAndPaths) {
  EXPECT_EQ(help_preset(scene, "body.springs.stretch", false), help_preset(scene, "stretch", false));
  EXPECT_EQ(help_preset(scene, "scene.body.springs.stretch", false), help_preset(scene, "stretch", false));
  const std::string both = help_preset(scene, "key", false); // two types share the name
  EXPECT_NE(both.find("scene.camera.key"), std::string::npos);
  EXPECT_NE(both.find("scene.map.key"), std::string::npos);
  EXPECT_EQ(help_preset(scene, "map.key", false).find("camera"), std::string::npos);
  EXPECT_EQ(help_preset(scene, "springs.stretch", false), help_preset(scene, "stretch", false))
      << "the end of a path";
}

TEST(Help, HoldsEveryElementWithinAHundredColumns) {
  const std::string page = help_preset(scene, std::nullopt, false);
  for (const std::string path :
       {"scene  (the root)", "scene.body  (one or more)", "scene.body.tear  (any number)",
        "scene.body.sheet  (exactly one)", "scene.camera.key"})
    EXPECT_NE(page.find("\n" + path), std::string::npos) << path;
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 101U) << line; // "·" is two bytes
}

TEST(Help, FoldsLongLines) {
  std::string what = "word";
  for (int i = 0; i < 60; ++i) what += " word";
  const ElementType wordy{"wordy", what, {text("name", what)}, {}};
  std::istringstream lines(help_preset(wordy, std::nullopt, false));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100U) << line;
}

TEST(Help, ColoursOnlyWhenAsked) {
  EXPECT_EQ(help_preset(scene, std::nullopt, false).find('\033'), std::string::npos);
  EXPECT_NE(help_preset(scene, "stretch", true).find("\033[1mk\033[0m"), std::string::npos);
}

TEST(Help, RefusesAnUnknownElement) {
  try {
    help_preset(scene, "strech", false);
    FAIL();
  } catch (const UserError& error) {
    EXPECT_EQ(error.code, Exit::Usage);
    EXPECT_EQ(std::string(error.what()), "a preset has no element 'strech'");
    EXPECT_EQ(error.hint.find("did you mean 'stretch'? there are: body, camera"), 0U) << error.hint;
  }
}

} // namespace
} // namespace rend::help_test
