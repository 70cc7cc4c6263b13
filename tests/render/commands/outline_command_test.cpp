// Bodies from drawings and letters: what a run makes of the file, and where it says what is wrong.
#include "sim/font/font.h"
#include "tests/render/commands/program_run.h"

#include <gmock/gmock.h>

#include <fmt/format.h>

namespace rend::outline_command_test {
namespace {

using program::Outcome;
using program::TestFolder;
using testing::HasSubstr;
namespace fs = std::filesystem;

// A square of 4 x 4 with a hole of 2 x 2: as large as three quarters of it.
const char* const frame = "<svg>\n<rect width='4' height='4'/><g transform='translate(1 1)'><rect width='2' "
                          "height='2'/></g>\n</svg>\n";

std::string preset(const std::string& outline, const std::string& law = "") {
  return fmt::format(R"(<scene name="s">
<body name="b"><outline {} cell="0.02"/><mass density="1000" thickness="1e-3"/>
<springs><stretch k="1"/></springs>{}</body>
<world gravity="0 0 0"/><time step="1e-4" duration="2e-4"/></scene>)",
                     outline, law);
}

class OutlineCommand : public testing::Test {
protected:
  OutlineCommand() {
    fs::create_directories(place.path() / "in/drawings");
    place.write("in/drawings/frame.svg", frame);
    place.write("above.svg", frame);
  }
  Outcome run(const std::string& outline, const std::string& options = "--json -q") const {
    place.write("in/s.xml", preset(outline));
    return place.rend("run in/s.xml " + options);
  }
  const TestFolder place;
};

TEST_F(OutlineCommand, a_drawing_becomes_a_body_of_its_area) {
  const Outcome one = run(R"(file="drawings/frame.svg")"), two = run(R"(file="drawings/frame.svg" size="2")");
  ASSERT_EQ(one.code, 0) << one.err;
  EXPECT_NEAR(one.json()["mass"].get<double>(), 0.75, 0.01);
  EXPECT_NEAR(two.json()["mass"].get<double>(), 3, 0.02);
  EXPECT_EQ(one.json()["fragments"], 1);
}

TEST_F(OutlineCommand, what_is_wrong_with_a_drawing_is_told_with_its_place) {
  place.write("in/parts.svg", "<svg><circle r='1'/><circle cx='3' r='1'/></svg>");
  const Outcome parts = run(R"(file="parts.svg")");
  EXPECT_EQ(parts.code, 65);
  EXPECT_THAT(parts.err, HasSubstr("s.xml:2:31: the drawing falls into 2 parts that are not connected"));
  place.write("in/faulty.svg", "<svg>\n<path d='M 0 0 L x'/></svg>");
  const Outcome faulty = run(R"(file="faulty.svg")");
  EXPECT_EQ(faulty.code, 65);
  EXPECT_THAT(faulty.err, HasSubstr("in/faulty.svg:2:18: <path>: command L of the path needs a number"));
  const Outcome none = run(R"(file="none.svg")");
  EXPECT_EQ(none.code, 66);
  EXPECT_THAT(none.err, HasSubstr("in/none.svg: there is no such file"));
}

TEST_F(OutlineCommand, a_drawing_lies_beside_the_preset_or_is_allowed) {
  const Outcome outside = run(R"(file="../above.svg")");
  EXPECT_EQ(outside.code, 65);
  EXPECT_THAT(outside.err, HasSubstr("put the drawing beside the preset"));
  EXPECT_EQ(run(R"(file="../above.svg")", "--json -q --allow-path").code, 0);
}

TEST_F(OutlineCommand, a_drawing_is_not_written_over) {
  const Outcome over = run(R"(file="drawings/frame.svg")", "--diagnostics in/drawings/frame.svg");
  EXPECT_EQ(over.code, 64);
  EXPECT_THAT(over.err, HasSubstr("the drawing 'in/drawings/frame.svg' would be overwritten by"));
}

// What was begun with another drawing is not gone on with.
TEST_F(OutlineCommand, a_changed_drawing_makes_another_scene) {
  NEEDS_PNG;
  place.write("in/s.xml", preset(R"(file="drawings/frame.svg")"));
  const std::string render = "render in/s.xml -o out --fps 1e4 --size 32x18 -q --resume";
  ASSERT_EQ(place.rend(render).code, 0);
  const std::string before = program::content(place.path() / "out/00000.png");
  EXPECT_EQ(place.rend(render).code, 0);
  EXPECT_EQ(program::content(place.path() / "out/00000.png"), before);
  place.write("in/drawings/frame.svg", "<svg><rect width='4' height='1'/></svg>");
  EXPECT_EQ(place.rend(render).code, 0);
  EXPECT_NE(program::content(place.path() / "out/00000.png"), before);
}

TEST_F(OutlineCommand, letters_are_the_parts_of_a_body) {
  if (!has_font()) GTEST_SKIP() << "built without the font";
  const Outcome word = run(R"(text="REND" size="2")");
  ASSERT_EQ(word.code, 0) << word.err;
  EXPECT_EQ(word.json()["fragments"], 4);
  EXPECT_EQ(run(R"(text="A")").json()["fragments"], 1);
}

} // namespace
} // namespace rend::outline_command_test
