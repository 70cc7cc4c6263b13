// Messages of commands, as someone reads them who knows no more than the line that was typed: they name what
// was typed, and what to type instead.
#include "tests/render/commands/program_run.h"
#include "tests/render/needs.h"

#include <gmock/gmock.h>

namespace rend::words_test {
namespace {

using program::Outcome;
using program::TestFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class CommandWords : public testing::Test {
protected:
  void SetUp() override { place.write("pulled.xml", program::pulled); }
  std::string err(const std::string& line, int code) const {
    const Outcome outcome = place.rend(line);
    EXPECT_EQ(outcome.code, code) << line;
    return outcome.err;
  }

  const TestFolder place;
};

TEST_F(CommandWords, tell_why_no_preset_is_listed) {
  std::filesystem::create_directory(place.path() / "empty");
  EXPECT_EQ(place.rend("list empty").out, "there are no presets in empty: files *.xml with a <scene>\n");
  EXPECT_EQ(
      place.rend("list . --thesis").out,
      "no preset of . names a figure of the thesis (attribute thesis of <scene>); rend list . lists all 1\n");
  EXPECT_EQ(place.rend("list empty --json").out, "[]\n");
  EXPECT_THAT(err("list pulled.xml", 66),
              HasSubstr("pulled.xml: this is a file, and rend list takes a folder"));
}

TEST_F(CommandWords, name_a_word_that_is_no_command_of_a_command) {
  EXPECT_THAT(err("mesh inof box.obj", 64), HasSubstr("rend mesh has no command 'inof'\n  hint: did you mean "
                                                      "'info'? there are: info, convert, fill"));
  EXPECT_THAT(err("mesh", 64), HasSubstr("rend mesh needs a command: info, convert, fill"));
  EXPECT_THAT(err("rule lits", 64), HasSubstr("did you mean 'list'? there are: list, show, check, draw"));
}

TEST_F(CommandWords, name_the_option_that_was_given) {
  EXPECT_THAT(err("batch pulled.xml --run --sweep body.tear.threshold", 64),
              AllOf(HasSubstr("--sweep body.tear.threshold: there is no '=' in it"),
                    HasSubstr("write --sweep PATH=V,V,..."), Not(HasSubstr("--set"))));
  EXPECT_THAT(err("batch pulled.xml --run --sweep body.tear.threshold=1:2:0", 64),
              HasSubstr("--sweep 'body.tear.threshold=1:2:0': '1:2:0' is no range of values"));
  EXPECT_THAT(err("check pulled.xml --only zzz", 64),
              AllOf(HasSubstr("--only: the name of no case has 'zzz' in it\n  hint: --list names all")));
  EXPECT_THAT(err("check --quick --only zzz", 64), AllOf(HasSubstr("no case of --quick has 'zzz'"),
                                                         HasSubstr("the groups of cases are stiffness, ")));
  EXPECT_THAT(err("run pulled.xml --export vtu --frames 99", 64),
              HasSubstr("--frames names no frame of this clip\n  hint: it has frames 0 to 6"));
  EXPECT_THAT(err("run pulled.xml --steps 0 --export vtu --frames 9", 64), HasSubstr("it has frame 0 alone"));
}

TEST_F(CommandWords, do_not_take_a_file_name_for_a_format) {
  place.write("box.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  for (const char* line : {"rule draw star-face -o 'x.bmp'", "mesh convert box.off 'x.bmp'"})
    EXPECT_THAT(err(line, 64), HasSubstr("'x.bmp': its ending names no format that rend can write")) << line;
}

TEST_F(CommandWords, speak_of_a_preset_only_where_there_is_one) {
  EXPECT_THAT(err("mesh info nowhere.obj", 66),
              AllOf(HasSubstr("nowhere.obj: there is no such mesh file"), Not(HasSubstr("preset"))));
  place.write("mesh.xml", R"(<scene name="m"><body><mesh file="no.obj"/><mass total="1"/></body>
                             <time step="1" duration="1"/></scene>)");
  EXPECT_THAT(err("run mesh.xml", 66), HasSubstr("its name is relative to the folder of the preset"));
  if (!png_available()) return;
  std::filesystem::create_directory(place.path() / "pictures");
  EXPECT_THAT(err("diff pictures pictures -t pulled.xml", 2),
              HasSubstr("a file of tolerances begins with <tolerances>, not with <scene>"));
}

TEST_F(CommandWords, count_as_english_does) {
  EXPECT_THAT(place.rend("run pulled.xml --steps 1 -q").out, HasSubstr("pulled: 1 step of "));
  EXPECT_THAT(place.rend("run pulled.xml --steps 2 -q").out, HasSubstr("pulled: 2 steps of "));
  EXPECT_THAT(place.rend("check --only stiffness/chain/rk45/1e12 -q").out, HasSubstr("1 case in "));
}

TEST_F(CommandWords, tell_what_a_figure_of_a_run_is) {
  EXPECT_THAT(place.rend("run pulled.xml --steps 1 -q").out,
              AllOf(HasSubstr("shear isotropic, 70 bend provot; each is evaluated in every step"),
                    HasSubstr(", a hash of positions, velocities and mesh"),
                    HasSubstr("J potential in gravity")));
}

TEST_F(CommandWords, do_not_call_nothing_well_formed) {
  EXPECT_EQ(place.rend("rule check pulled.xml").out, "pulled.xml states no rule and no script\n");
}

TEST_F(CommandWords, of_help_lead_on) {
  EXPECT_THAT(err("help completion", 64), HasSubstr("no shell is named\n  hint: shells: bash, zsh, fish"));
  EXPECT_THAT(err("help run camera", 64),
              HasSubstr("rend help preset camera explains this element of a preset"));
  EXPECT_THAT(err("help run x", 64), HasSubstr("rend help run prints the whole page"));
}

} // namespace
} // namespace rend::words_test
