#include "tests/render/commands/program_run.h"
#include "tests/test_paths.h"

#include <gtest/gtest.h>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <unistd.h>

namespace rend::completion_test {
namespace {

using program::Outcome;
using program::TestFolder;

// Runs the real shells: each loads the script that the program prints, and completes with it.
class Completion : public testing::Test {
protected:
  void SetUp() override {
    place.write("plate.xml", "");
    place.write("other.txt", "");
    ASSERT_EQ(place.shell("mkdir meshes").code, 0);
  }
  bool has(const std::string& shell) const { return place.shell("command -v " + shell).code == 0; }
  void print(const std::string& shell) const {
    ASSERT_EQ(place.rend("help completion " + shell + " > ../" + shell).code, 0);
  }

  // What bash offers for the last of these words, split as bash does.
  std::string bash(const std::string& words) const {
    const Outcome outcome = place.shell("bash -c 'source ../bash; COMP_WORDS=(rend " + words +
                                        "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _rend; "
                                        "echo \"${COMPREPLY[*]}\"'");
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.err, "");
    return outcome.out.substr(0, outcome.out.size() - 1);
  }
  // The same for fish, without descriptions, separated by blanks.
  std::string fish(const std::string& line) const {
    const Outcome outcome = place.shell("HOME=$PWD/.. fish -c 'source ../fish; complete -C \"rend " + line +
                                        "\"' | cut -f1 | tr '\\n' ' '");
    EXPECT_EQ(outcome.err, "");
    return outcome.out.substr(0, outcome.out.find_last_not_of(' ') + 1);
  }
  const TestFolder place;
};

TEST_F(Completion, of_bash_offers_commands_options_choices_files_and_attributes) {
  print("bash");
  EXPECT_EQ(place.shell("bash -n ../bash").err, "");
  EXPECT_EQ(bash("inf"), "info");
  EXPECT_EQ(bash("--ver"), "--version");
  EXPECT_EQ(bash("render --vid"), "--video");
  EXPECT_EQ(bash("render --video m"), "mp4 mkv");
  EXPECT_EQ(bash("render --video = m"), "mp4 mkv"); // --video=m
  EXPECT_EQ(bash("render p"), "plate.xml");
  EXPECT_EQ(bash("render \"\""), "plate.xml meshes");
  EXPECT_EQ(bash("render plate.xml -o m"), "meshes");
  EXPECT_EQ(bash("mesh con"), "convert");
  EXPECT_EQ(bash("mesh info o"), "other.txt");
  EXPECT_EQ(bash("render --set time.integ"), "time.integrator=");
  EXPECT_EQ(bash("render --set time.integrator = rk"), "rk4 rk45");
  EXPECT_EQ(bash("render --set \"body[left].sheet.pat\""), "body[left].sheet.pattern=");
  EXPECT_EQ(bash("render --set \"body[left].sheet.pattern\" = cr"), "crossed");
  EXPECT_EQ(bash("study plate.xml --integrators verlet,rk4"), "verlet,rk4 verlet,rk45");
  EXPECT_EQ(bash("help sch"), "schema");
  EXPECT_EQ(bash("help preset stret"), "stretch");
  EXPECT_EQ(bash("render --frames 1"), "");
}

TEST_F(Completion, of_bash_offers_all_that_the_help_of_each_command_lists) {
  print("bash");
  std::istringstream commands(bash("\"\""));
  for (std::string command; commands >> command;) {
    std::istringstream words(bash(command + " --"));
    const std::set<std::string> offered{std::istream_iterator<std::string>(words), {}};
    const Outcome help = place.shell(std::string(test::rend_program) + " " + command +
                                     " --help | grep -oE '^  (-[a-z], )?--[a-z-]+' | grep -oE -- '--[a-z-]+'");
    std::istringstream options(help.out);
    for (std::string option; options >> option;) EXPECT_TRUE(offered.count(option)) << command << " " << option;
  }
}

TEST_F(Completion, of_fish_offers_commands_options_choices_and_files) {
  if (!has("fish")) GTEST_SKIP() << "fish is not installed";
  print("fish");
  EXPECT_EQ(fish("inf"), "info");
  EXPECT_EQ(fish("render --vid"), "--video");
  EXPECT_EQ(fish("render --video m"), "mkv mp4");
  EXPECT_EQ(fish("render plat"), "plate.xml");
  EXPECT_EQ(fish("mesh con"), "convert");
  EXPECT_EQ(fish("render --set time.integrator=rk"), "time.integrator=rk4 time.integrator=rk45");
  EXPECT_EQ(fish("help preset stret"), "stretch");
}

// zsh in a pseudo-terminal: its completion works on a terminal only.
TEST_F(Completion, of_zsh_offers_commands_options_choices_and_files) {
  if (!has("zsh")) GTEST_SKIP() << "zsh is not installed";
  if (::access("/dev/pts/ptmx", F_OK) != 0) GTEST_SKIP() << "there are no pseudo-terminals here";
  ASSERT_EQ(place.rend("help completion zsh > _rend").code, 0);
  EXPECT_EQ(place.shell("zsh -n _rend").err, "");
  place.write("type", R"zsh(zmodload zsh/zpty
zpty shell zsh -f -i
zpty -w shell "PS1=; fpath=($PWD \$fpath); autoload -Uz compinit; compinit -u -D; stty cols 200; print rea''dy"
zpty -r shell seen '*ready*'
for line in 'rend inf' 'rend render --vide' 'rend render --video=we' 'rend render pla' 'rend mesh conv' \
  'rend help sche' 'rend render --set time.integ' 'rend run --set time.integrator=symp' \
  'rend study plate.xml --integrators symp'; do
  shown=$'\C-u'"echo '${line}' >/dev/null; print -r -- "$'\C-u'"$line"$'\t'
  zpty -n -w shell "$shown"$'\C-a'"print -r -- '<"$'\C-e'">'"$'\n'
  zpty -r shell seen $'*\n<*>*'
  print -r -- ${${seen##*$'\n'<}%%>*}
done
)zsh");
  const Outcome outcome = place.shell("timeout 60 zsh type");
  // When the cursor moves on, zsh removes the blank or = that it had inserted.
  EXPECT_EQ(outcome.out, "rend info\nrend render --video\nrend render --video=webm\nrend render plate.xml\n"
                         "rend mesh convert\nrend help schema\nrend render --set time.integrator\n"
                         "rend run --set time.integrator=symplectic\n"
                         "rend study plate.xml --integrators symplectic\n")
      << outcome.err;
}

TEST_F(Completion, of_an_unknown_shell_is_refused_with_those_there_are) {
  const Outcome outcome = place.rend("help completion bsh");
  EXPECT_EQ(outcome.code, 64);
  EXPECT_NE(outcome.err.find("did you mean 'bash'? shells: bash, zsh, fish"), std::string::npos) << outcome.err;
}

} // namespace
} // namespace rend::completion_test
