// Names of files, bodies and groups may contain anything: none of it may control a terminal, fake a line of
// output, or break a page.
#include "render/console/json_text.h"
#include "sim/base/printable.h"
#include "tests/render/commands/program_run.h"
#include "tests/render/needs.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <sstream>

namespace rend::names_test {
namespace {

using program::content;
using program::Outcome;
using program::TestFolder;
using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

// A colour code; a line end followed by text that looks like our error; DEL; U+009B, which starts a control
// sequence like ESC [; U+202E, which reverses the direction of text; a byte that is not UTF-8. In single quotes
// the shell passes it unchanged.
const std::string evil = "a\033[31m\nrend: error: made up\x7f\u009b1m\u202eb\xff";
const std::string shown = R"(a\x1b[31m\nrend: error: made up\x7f\u{9b}1m\u{202e}b\xff)";
// The same as far as XML can represent it.
const std::string in_xml = "a&#10;rend: error: made up&#127;&#x9b;1m&#x202e;b";

void expect_tame(const std::string& text, const std::string& where) {
  EXPECT_EQ(printable_lines(text), text) << where;
  std::istringstream lines(text);
  int made_up = 0;
  for (std::string line; std::getline(lines, line);) made_up += line.starts_with("rend: error: made up");
  EXPECT_EQ(made_up, 0) << where << ":\n" << text;
}

class Names : public testing::Test {
protected:
  Names() { place.write("pulled.xml", program::pulled); }

  Outcome rend(std::string arguments, int code) const {
    for (std::size_t at; (at = arguments.find("EVIL")) != std::string::npos;) arguments.replace(at, 4, evil);
    const Outcome outcome = place.rend(arguments);
    EXPECT_EQ(outcome.code, code) << printable(arguments) << "\n" << printable(outcome.err);
    expect_tame(outcome.out, "stdout of " + printable(arguments));
    expect_tame(outcome.err, "stderr of " + printable(arguments));
    return outcome;
  }
  std::string preset(const std::string& body) const {
    std::string text = program::pulled;
    return text.replace(text.find("\"cloth\""), 7, "\"" + body + "\"");
  }

  const TestFolder place;
};

TEST_F(Names, stand_in_errors_as_escapes) {
  EXPECT_THAT(rend("run 'EVIL.xml'", 66).err,
              HasSubstr("rend: error: " + shown + ".xml: there is no such file"));
  place.write(evil + ".xml", "<scene name=\"s\"><bady/></scene>");
  EXPECT_THAT(rend("run 'EVIL.xml'", 65).err, HasSubstr(shown + ".xml:1:17: there is no <bady> in <scene>"));
  EXPECT_THAT(rend("'EVIL'", 64).err, HasSubstr(R"(there is no command 'a\x1b[31m\nrend: error: made up)"));
  EXPECT_THAT(rend("run pulled.xml '--EVIL'", 64).err, HasSubstr(shown)); // a message of CLI11
  rend("run pulled.xml 'EVIL'", 64);
  rend("run pulled.xml --set 'EVIL'", 64);
  rend("run pulled.xml --set 'body.EVIL=1'", 64);
  EXPECT_THAT(rend("run pulled.xml --set 'time.step=EVIL'", 65).err, HasSubstr("--set time.step=" + shown));
  rend("run pulled.xml --set 'body.tear.criterion=EVIL'", 65);
  rend("run pulled.xml --set 'body[EVIL].mass.total=1'", 64);
  rend("run pulled.xml --steps 'EVIL'", 64);
  rend("run pulled.xml --steps 1 --diagnostics 'none/EVIL'", 73);
  rend("mesh info 'EVIL.off'", 66);
  rend("help 'EVIL'", 64);
  rend("help preset 'EVIL'", 64);
  if (png_available()) rend("batch 'EVIL.xml' none", 66);
}

TEST_F(Names, of_bodies_stand_in_notes_and_figures_as_escapes) {
  place.write("body.xml", preset(in_xml));
  const std::string called = R"(a\nrend: error: made up\x7f\u{9b}1m\u{202e}b)";
  EXPECT_THAT(rend("run body.xml", 0).out, HasSubstr("of '" + called + "' above"));
  EXPECT_THAT(rend("info body.xml", 0).out, HasSubstr("body " + called + ": a sheet"));
  rend("run pulled.xml --steps 1 --set 'body.name=EVIL'", 0);
  // JSON has the exact names, escaped in its own way.
  const Outcome json = rend("run body.xml --json --events e.jsonl --export obj -o states --frames 0", 0);
  EXPECT_EQ(json.json()["laws"][0]["body"], "a\nrend: error: made up\x7f\u009b1m\u202eb");
  EXPECT_THAT(json.out, HasSubstr(R"(a\nrend: error: made up\u007f\u009b1m\u202eb)"));
  expect_tame(content(place.path() / "e.jsonl"), "events");
  EXPECT_THAT(content(place.path() / "states/00000.obj"), HasSubstr("\no a_rend:_error:_made_up__1m_b\n"));
}

TEST_F(Names, of_groups_and_mesh_files_stand_on_one_line) {
  place.write(evil + ".msh",
              "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n0 4 \"to\033[31mp\u202e\u009b\"\n"
              "$EndPhysicalNames\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n$Elements\n2\n"
              "1 15 2 4 0 4\n2 4 2 0 0 1 3 2 4\n$EndElements\n"); // inverted, which gives a note
  const Outcome info = rend("mesh info 'EVIL.msh'", 0);
  EXPECT_THAT(info.out, AllOf(HasSubstr(shown + ".msh: a solid of 4 vertices"),
                              HasSubstr(R"(group 'to\x1b[31mp\u{202e}\u{9b}')"),
                              HasSubstr("note: " + shown + ".msh: 1 of 1 cells were inside out")));
  EXPECT_THAT(rend("mesh info 'EVIL.msh' --json", 0).out, HasSubstr(R"(to\u001b[31mp\u202e\u009b)"));
  EXPECT_THAT(rend("mesh convert 'EVIL.msh' b.moka", 0).err, HasSubstr("note: " + shown + ".msh: 1 of 1"));
}

// One name begins with the words that begin an error message.
TEST_F(Names, of_jobs_stand_in_lists_and_pages_as_escapes) {
  NEEDS_PNG;
  place.write(evil + ".xml", program::pulled);
  place.write("bad.xml", "<scene name=\"s\"/>");
  place.write("javascript:x#?%.xml", program::pulled);
  const std::string name = "batch 'EVIL.xml' bad.xml 'javascript:x#?%.xml' --frames 0 -o ";
  const Outcome batch = rend(name + "'out EVIL'", 1);
  const std::string job = "  " + shown; // the time that is left follows, unless this job was the last to end
  EXPECT_THAT(batch.err, AnyOf(HasSubstr(job + "  about"), HasSubstr(job + "\n")));
  EXPECT_THAT(batch.out, HasSubstr("2 of 3 jobs done"));
  EXPECT_THAT(batch.out, HasSubstr("failed: bad: bad.xml:1:1: <scene> needs a <body>"));
  const std::string page = content(place.path() / ("out " + evil) / "index.html");
  expect_tame(page, "page");
  EXPECT_THAT(page, AllOf(HasSubstr(">" + shown + "</a>"), HasSubstr("href=\"a%1B%5B31m%0Arend%3A%20"),
                          HasSubstr("href=\"javascript%3Ax%23%3F%25/\"")));
  std::istringstream lines(rend(name + "lines --json -q", 1).out);
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) EXPECT_TRUE(nlohmann::json::accept(line)) << line;
  EXPECT_EQ(count, 3);
  EXPECT_THAT(rend("render pulled.xml --frames 0 -o 'EVIL'", 0).out, HasSubstr("1 frame in " + shown));
}

TEST_F(Names, of_pictures_stand_in_reports_as_escapes) {
  NEEDS_PNG;
  for (const char* folder : {"a", "b"}) fs::create_directories(place.path() / folder);
  place.write("a/" + evil + ".png", "none");
  place.write("b/" + evil + ".png", "none");
  place.write("a/" + evil + "2.png", "none");
  EXPECT_THAT(rend("diff a b -o report --junit junit.xml", 2).out,
              HasSubstr("unreadable  " + shown + ".png: "));
  for (const char* file : {"report/index.html", "report/diff.json", "junit.xml"})
    expect_tame(content(place.path() / file), file);
  EXPECT_EQ(place.shell("xmllint --noout junit.xml").code, 0);
  std::istringstream lines(rend("diff a b --json-lines", 2).out);
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) EXPECT_TRUE(nlohmann::json::accept(line)) << line;
  EXPECT_EQ(count, 2);
}

TEST_F(Names, of_studies_and_cases_stand_in_tables_as_escapes) {
  place.write(evil + ".xml", program::pulled);
  EXPECT_THAT(rend("check 'EVIL.xml' --list --only threads", 0).out, HasSubstr(shown + "/threads\n"));
  const Outcome study = rend("study 'EVIL.xml' --quick --integrators symplectic,rk4 --duration 0.01 "
                             "--sweep 'body.look.colour=#c8323c,#2a7f8e' --sweep 'body.name=EVIL,c' -o 'EVIL'",
                             0);
  EXPECT_THAT(study.out, HasSubstr("The page is " + shown + "/index.html"));
  for (const char* file : {"index.html", "study.csv", "study.json"}) {
    const std::string text = content(place.path() / evil / file);
    EXPECT_THAT(text, HasSubstr("made up")) << file;
    std::string lines = text; // CSV ends lines with both
    for (std::size_t at; (at = lines.find("\r\n")) != std::string::npos;) lines.erase(at, 1);
    expect_tame(lines, file);
  }
}

TEST(JsonText, escapes_what_acts_and_is_read_as_it_was) {
  const std::string name = "a\033\n\x7f\u0085\u202e\u2069\ufffe\U0001fffe\u00e9\U0001d11e";
  const nlohmann::ordered_json json{{name, name}};
  EXPECT_EQ(printable(text_of(json)), text_of(json));
  EXPECT_EQ(nlohmann::ordered_json::parse(text_of(json)), json);
  EXPECT_THAT(text_of(json), HasSubstr(R"(a\u001b\n\u007f\u0085\u202e\u2069\ufffe\ud83f\udffe)"
                                       "\u00e9\U0001d11e"));
}

} // namespace
} // namespace rend::names_test
