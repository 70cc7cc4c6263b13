#include "render/help/manual.h"

#include "render/picture/scene_preset.h"
#include "tests/render/commands/program_run.h"
#include "tests/render/help/small_table.h"

#include <gtest/gtest.h>
#include <set>

namespace rend::manual_test {
namespace {

using program::Outcome;
using program::TestFolder;

const CommandUsage small{"tear",
                         "tear: tears things",
                         "",
                         {},
                         {{{"-h", "--help"}, "", "print this page", "", false, false}},
                         {{"paper",
                           "tear paper",
                           "Never more than 'twice'.\n.5 sheets\n'or' a part.",
                           {{{"sheet"}, "FILE", "what is torn", "", true, false}},
                           {{{"-n", "--pieces"}, "N", ".5 is half; a back\\slash", "2", false, false},
                            {{"--wet"}, "", "first", "", true, false}},
                           {}}}};

TEST(Manual, is_lines_of_troff) {
  const std::string page = manual(small, "1.2.3", "2026-11-22");
  EXPECT_EQ(page.find(".TH tear 1 \"2026-11-22\" \"tear 1.2.3\"\n"), 0U) << page;
  for (const char* part :
       {".SH NAME\ntear \\- tears things\n",
        ".SS \\fBtear paper\\fR [\\fIoptions\\fR] \\fIFILE\\fR\nTear paper.\n",
        ".TP\n\\fIFILE\\fR\nwhat is torn.\n",
        ".TP\n\\fB\\-n\\fR, \\fB\\-\\-pieces\\fR \\fIN\\fR\n\\&.5 is half; a back\\eslash. Default: "
        "\\fB2\\fR.\n",
        ".TP\n\\fB\\-\\-wet\\fR\nfirst. Required.\n",
        "Never more than 'twice'.\n.br\n\\&.5 sheets\n.br\n\\&'or' a part.\n", ".SH EXIT STATUS\n"})
    EXPECT_NE(page.find(part), std::string::npos) << part << "\n" << page;
}

TEST(Manual, of_presets_has_every_element) {
  const std::string page = manual_of_presets(small_table::scene, "1.2.3", "");
  for (const char* part : {".SS scene.body.springs.stretch\n", ".TP\n\\fBk\\fR\nstiffness\n.br\n"})
    EXPECT_NE(page.find(part), std::string::npos) << part << "\n" << page;
}

// By two independent troff programs.
TEST(Manual, is_read_without_warnings) {
  const TestFolder place;
  ASSERT_EQ(place.rend("help man > rend.1").code, 0);
  ASSERT_EQ(place.rend("help man preset > rend-preset.5").code, 0);
  const bool has_man = place.shell("command -v man").code == 0,
             has_mandoc = place.shell("command -v mandoc").code == 0;
  if (!has_man && !has_mandoc) GTEST_SKIP() << "neither man nor mandoc is installed";
  for (const std::string file : {"rend.1", "rend-preset.5"}) {
    if (has_man) {
      EXPECT_EQ(place.shell("man --warnings -E UTF-8 -Tutf8 -Z -l " + file + " >/dev/null").err, "");
    }
    if (has_mandoc) {
      EXPECT_EQ(place.shell("mandoc -T lint -W warning " + file).out, "");
    }
  }
}

TEST(Version, tells_commit_and_libraries) {
  const TestFolder place;
  const Outcome outcome = place.rend("--version");
  EXPECT_EQ(outcome.code, 0);
  std::istringstream lines(outcome.out);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line.find("rend "), 0U);
  EXPECT_NE(line.find("commit"), std::string::npos);
  std::set<std::string> names;
  for (std::string name; lines >> name; std::getline(lines, line)) names.insert(name);
  for (const char* name :
       {"compiler", "CLI11", "Eigen", "Expat", "fmt", "nlohmann_json", "oneTBB", "xxHash", "OpenGL"})
    EXPECT_TRUE(names.count(name)) << name;
}

} // namespace
} // namespace rend::manual_test
