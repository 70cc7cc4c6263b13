// rend rule and rend help rule, as a user runs them.
#include "render/files/png.h"
#include "sim/expression/functions.h"
#include "sim/house_rules/house_scripts.h"
#include "sim/rules/rule_values.h"
#include "tests/render/commands/program_run.h"
#include "tests/test_paths.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace rend::rule_command_test {
namespace {

using program::Outcome;
using program::TestFolder;
using testing::HasSubstr;
using testing::StartsWith;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// What stands in the page of `rend help rule` from <rules> to </rules>.
std::string examples_of(const std::string& page) {
  const std::size_t from = page.find("\n<rules>\n"), to = page.find("</rules>", from);
  return from == std::string::npos ? "" : page.substr(from + 1, to + 8 - from);
}

std::string scene(const std::string& shape) {
  return "<scene name=\"s\"><rules file=\"mine.xml\"/><body name=\"b\">" + shape +
         "<mass total=\"1\"/></body><time step=\"1e-3\" integrator=\"symplectic\" duration=\"0\"/></scene>";
}

std::size_t known() {
  return house_rules().size() + house_scripts().size();
}

TEST(RuleCommand, lists_all_rules_and_scripts_of_the_house) {
  const TestFolder place;
  const std::vector<std::string> lines = lines_of(place.rend("rule list").out);
  const auto json = place.rend("rule list --json").json();
  ASSERT_EQ(lines.size(), known());
  ASSERT_EQ(json.size(), known());
  const auto expect = [&](std::size_t n, const auto& each, const char* kind) {
    EXPECT_THAT(lines[n], StartsWith(each.name() + " "));
    EXPECT_THAT(lines[n], HasSubstr(each.settings.about));
    EXPECT_EQ(json[n]["name"], each.name());
    EXPECT_EQ(json[n][kind], each.print());
  };
  for (std::size_t n = 0; n < house_rules().size(); ++n) expect(n, house_rules()[n], "rule");
  for (std::size_t n = 0; n < house_scripts().size(); ++n)
    expect(house_rules().size() + n, house_scripts()[n], "script");
}

TEST(RuleCommand, shows_rules_that_can_be_read_again) {
  const TestFolder place;
  std::string file = "<?xml version=\"1.0\"?>\n<!-- <scene> -->\n<rules>\n";
  for (const auto& rule : place.rend("rule list --json").json()) {
    std::string text = rule.contains("rule") ? rule["rule"] : rule["script"];
    file += text.insert(text.find("name=\"") + 6, "my-");
  }
  place.write("mine.xml", file + "</rules>\n");
  EXPECT_EQ(place.rend("rule check mine.xml").out, fmt::format("{} rules and {} scripts are well formed\n",
                                                               house_rules().size(), house_scripts().size()));
  const auto read = place.rend("rule list mine.xml --json").json();
  ASSERT_EQ(read.size(), 2 * known());
  for (std::size_t n = 0; n < house_rules().size(); ++n) {
    std::string text = house_rules()[n].print();
    text.insert(text.find("name=\"") + 6, "my-");
    EXPECT_EQ(read[n]["rule"], text);
    EXPECT_EQ(read[n]["from"], "mine.xml");
  }
  for (std::size_t n = 0; n < house_scripts().size(); ++n) {
    std::string text = house_scripts()[n].print();
    text.insert(text.find("name=\"") + 6, "my-");
    EXPECT_EQ(read[house_rules().size() + n]["script"], text);
  }
  EXPECT_THAT(place.rend("rule show my-star-face --in mine.xml").out,
              StartsWith("my-star-face: a triangle on"));
}

TEST(RuleCommand, tells_what_a_rule_does) {
  const TestFolder place;
  const auto star = place.rend("rule show star-volume --json").json();
  EXPECT_EQ(star["hooks"][0]["orbit"], "<0,1,2>");
  EXPECT_EQ(star["creates"], nlohmann::json({"b", "c", "d"}));
  EXPECT_EQ(star["sheets"], false);
  const auto inner = place.rend("rule show remove-inner-face --json").json();
  EXPECT_EQ(inner["removes"], nlohmann::json({"a"}));
  EXPECT_EQ(inner["sheets"], true);
  EXPECT_EQ(place.rend("rule show unsew-face --json").json()["sheets"], false); // it needs a neighbour by α3
  EXPECT_EQ(place.rend("rule show move --json").json()["arguments"]["v"], "point(0, 0, 0)");
}

TEST(RuleCommand, tells_what_a_script_does) {
  const TestFolder place;
  const auto script = place.rend("rule show divide-tetrahedra --json").json();
  EXPECT_EQ(script["hooks"][0]["orbit"], "<0,1,2,3>");
  EXPECT_EQ(script["applies"],
            nlohmann::json({"insert-vertex", "cut-face-corner", "cut-volume-corner", "divide-bipyramid"}));
  EXPECT_EQ(script["sheets"], false);
  EXPECT_EQ(place.rend("rule show delete-face --json").json()["sheets"], true);
  EXPECT_EQ(place.rend("rule show split-vertex-of-sheet --json").json()["asks_for"], "across");
  EXPECT_THAT(place.rend("rule show extrude-hull").out, HasSubstr("applies    extrude-away, sew-faces"));
  const Outcome drawn = place.rend("rule draw delete-face -o a.svg");
  EXPECT_EQ(drawn.code, 0);
  EXPECT_EQ(drawn.err, "");
  EXPECT_THAT(program::content(place.path() / "a.svg"),
              HasSubstr("1. at each e*(0): unsew-edge, wherever it applies"));
}

// Its title is as wide as the name is long.
TEST(RuleCommand, draws_no_picture_of_more_pixels_than_pictures_have) {
  if (!png_available()) GTEST_SKIP();
  const TestFolder place;
  const std::string name(100'000, 'n');
  place.write("long.xml", "<rule name=\"" + name + "\" left=\"a*(0)\" right=\"a(0)\"/>");
  const Outcome picture = place.rend("rule draw " + name + " --in long.xml -o x.png");
  EXPECT_EQ(picture.code, 65);
  EXPECT_THAT(picture.err, HasSubstr("at most 8192 a side"));
  EXPECT_EQ(place.rend("rule draw " + name + " --in long.xml -o x.svg").code, 0);
  EXPECT_EQ(place.files(), (std::vector<std::string>{"long.xml", "x.svg"}));
}

TEST(RuleCommand, checks_a_whole_file) {
  const TestFolder place;
  place.write("bad.xml", R"xml(<rules>
  <rule name="r" left="a*(0,1)" right="a(0,1) b(0,1)"/>
  <rule name="good" left="a*(0)" right="a(0)"/>
  <rule name="s" left="a*(0,1)" right="a(0)"/>
  <script name="t" hook="a*(0,1)"><for each="e*(0)" apply="gone"/></script>
</rules>)xml");
  const Outcome bad = place.rend("rule check bad.xml");
  EXPECT_EQ(bad.code, 65);
  for (const char* words :
       {"bad.xml:2:40: rule 'r'", "bad.xml:4:40: rule 's'", "bad.xml:5:60: there is no rule 'gone'"})
    EXPECT_THAT(bad.err, HasSubstr(words));
  EXPECT_THAT(bad.err, testing::Not(HasSubstr("bad.xml:3")));
  EXPECT_EQ(bad.out, "");
}

TEST(RuleCommand, warns_of_cells_that_are_open_at_a_border) {
  const TestFolder place;
  place.write("open.xml", R"xml(<rules>
  <rule name="r" left="a*(0,1,2) a|3" right="a(0,1,2) b(_,_,0) a|3 b|1,2,3">
    <set node="b" position="mean(a, component)"/></rule>
</rules>)xml");
  const Outcome checked = place.rend("rule check open.xml");
  EXPECT_EQ(checked.code, 0);
  EXPECT_EQ(checked.out, "1 rule is well formed\n");
  EXPECT_THAT(checked.err, HasSubstr("note: open.xml:2:"));
  EXPECT_THAT(checked.err,
              HasSubstr("rule 'r': at the border of a sheet, α2 of the hook is free, and with it α0 of "
                        "node b: a face is open there; <when test=\"not free(a, 2)\" at=\"all\"/>"));
  EXPECT_EQ(place.rend("rule check").err, "");
}

TEST(RuleCommand, refuses_vertices_that_become_one_without_a_position) {
  const TestFolder place;
  place.write("sew.xml",
              "<rules>\n  <rule name=\"r\" left=\"a*(0) b*(0) a|2 b|2\" right=\"a(0) b(0) a-2-b\"/>\n</rules>");
  const Outcome bad = place.rend("rule check sew.xml");
  EXPECT_EQ(bad.code, 65);
  EXPECT_THAT(bad.err, HasSubstr("sew.xml:2:"));
  EXPECT_THAT(bad.err, HasSubstr("nodes a and b are of two vertices on the left and of one on the right"));
  EXPECT_THAT(bad.err, HasSubstr("hint: <set node=\"a\" position=\"b\"/> is where that of b was"));
}

// Each applies the next one: those that go too deep are refused, and with them all that apply them.
TEST(RuleCommand, tells_the_first_and_the_last_of_many_that_are_refused) {
  const TestFolder place;
  std::string chain = "<rules>\n";
  for (int n = 0; n < 5000; ++n)
    chain += fmt::format("<script name=\"s{}\" hook=\"a*(0,1)\"><for each=\"e*(0)\" apply=\"s{}\"/></script>\n",
                         n, n + 1);
  place.write("chain.xml", chain + "</rules>");
  const Outcome bad = place.rend("rule check chain.xml");
  EXPECT_EQ(bad.code, 65);
  EXPECT_LT(bad.err.size(), 5000u);
  EXPECT_THAT(bad.err, HasSubstr("scripts apply scripts more than 20 deep"));
  EXPECT_THAT(bad.err, HasSubstr("script 's4998'"));
  EXPECT_THAT(bad.err, HasSubstr("note: 4979 more are refused; the last one:"));
}

// Nobody writes to the pipe: who opens it waits for ever.
TEST(RuleCommand, a_preset_cannot_name_a_pipe_as_its_rules) {
  const TestFolder place;
  place.write("s.xml", scene("<sheet cells=\"1 1\" size=\"1 1\"/>"));
  for (const char* made : {"mkfifo mine.xml", "ln -s /dev/null mine.xml", "mkdir mine.xml"}) {
    ASSERT_EQ(place.shell(std::string("rm -rf mine.xml; ") + made).code, 0);
    for (const char* command : {"run s.xml", "info s.xml", "rule list s.xml"}) {
      const Outcome bad =
          place.shell(std::string("timeout 20 ") + test::rend_program + " " + command + " --allow-path");
      EXPECT_EQ(bad.code, 65) << made << ": " << command << ": " << bad.err;
      EXPECT_THAT(bad.err, HasSubstr("s.xml:1:30: mine.xml: is not a regular file"));
    }
  }
}

TEST(RuleCommand, reads_a_file_that_is_one_rule) {
  const TestFolder place;
  place.write("one.xml", "<?xml version=\"1.0\"?>\n<rule name=\"r\" left=\"a*(0)\" right=\"a(0)\"/>\n");
  EXPECT_EQ(place.rend("rule check one.xml").out, "1 rule is well formed\n");
  place.write("two.xml",
              "<rule name=\"r\" left=\"a*(0)\" right=\"a(0)\"/>\n<rule name=\"s\" left=\"a*\" right=\"a\"/>\n");
  const Outcome two = place.rend("rule check two.xml");
  EXPECT_EQ(two.code, 65);
  EXPECT_THAT(two.err, HasSubstr("two.xml:2"));
  EXPECT_THAT(two.err, HasSubstr("<rules>"));
}

TEST(RuleCommand, refuses_by_the_table_of_exit_codes) {
  const TestFolder place;
  place.write("bad.xml", "<rules>\n  <rule name=\"r\" left=\"a*(0,1)\" right=\"a(0,1) b(0,1)\"/>\n</rules>");
  const Outcome bad = place.rend("rule check bad.xml");
  EXPECT_EQ(bad.code, 65);
  EXPECT_THAT(bad.err, HasSubstr("bad.xml:2:40: rule 'r': the new node b does not say what its α2 is"));
  EXPECT_EQ(place.rend("rule").code, 64);
  EXPECT_EQ(place.rend("rule check none.xml").code, 66);
  EXPECT_EQ(place.rend("rule check " + std::string(test::source_root) + "/README.md").code, 65);
  const Outcome unknown = place.rend("rule show star-faces");
  EXPECT_EQ(unknown.code, 64);
  EXPECT_THAT(unknown.err, HasSubstr("did you mean 'star-face'?"));
  EXPECT_EQ(place.rend("rule draw star-face -o a.pdf").code, 64);
  EXPECT_EQ(place.rend("rule draw star-face -o none/a.svg").code, 73);
  EXPECT_THAT(place.rend("rule draw star-face --on shet -o a.svg").err, HasSubstr("did you mean 'sheet'?"));
  EXPECT_EQ(place.rend("rule draw r --in bad.xml -o bad.xml").code, 64);
  EXPECT_EQ(place.files(), std::vector<std::string>{"bad.xml"});
}

TEST(RuleCommand, reads_the_rules_of_presets) {
  const TestFolder place;
  const std::string ball = std::string(test::source_root) + "/presets/rules/ball.xml";
  EXPECT_EQ(place.rend("rule check " + ball).out, "1 rule is well formed\n");
  const std::vector<std::string> lines = lines_of(place.rend("rule list " + ball).out);
  ASSERT_EQ(lines.size(), known() + 1);
  EXPECT_THAT(lines[0], StartsWith("round"));
  place.write("s.xml", "<scene name=\"s\"><rules file=\"../mine.xml\"/></scene>");
  EXPECT_EQ(place.rend("rule check s.xml").code, 65);
}

TEST(RuleCommand, draws) {
  const TestFolder place;
  ASSERT_EQ(place.rend("rule draw quarter-faces -o a.svg").code, 0);
  const std::string svg = program::content(place.path() / "a.svg");
  EXPECT_THAT(svg, StartsWith("<svg "));
  double width = 0, height = 0;
  ASSERT_EQ(std::sscanf(svg.c_str() + svg.find("width="), "width=\"%lf\" height=\"%lf\"", &width, &height), 2);
  if (!png_available() || place.rend("rule draw quarter-faces -o a.png").code == 64) return;
  const Image image = read_png(place.path() / "a.png");
  EXPECT_NEAR(image.width, 2 * width, 1.5);
  EXPECT_NEAR(image.height, 2 * height, 1.5);
}

TEST(RulePage, fits_on_a_page_and_names_all_functions) {
  const TestFolder place;
  const std::string page = place.rend("help rule").out;
  const std::vector<std::string> lines = lines_of(page);
  EXPECT_LE(lines.size(), 100U);
  for (const std::string& line : lines) {
    const auto columns = std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xc0) != 0x80; });
    EXPECT_LE(columns, 100) << line;
  }
  for (const ExpressionFunction& function : rule_vocabulary({}, {}))
    EXPECT_THAT(page, HasSubstr(function.name));
  for (const BuiltIn& each : built_ins()) EXPECT_THAT(page, HasSubstr(each.declared.name));
}

TEST(RulePage, has_examples_that_work) {
  const TestFolder place;
  place.write("mine.xml", examples_of(place.rend("help rule").out));
  ASSERT_EQ(place.rend("rule check mine.xml").out, "3 rules and 2 scripts are well formed\n");
  const auto build = [&](const std::string& shape) {
    place.write("s.xml", scene(shape));
    const Outcome outcome = place.rend("run s.xml --export obj -o out --json");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    std::string obj;
    for (const std::string& file : place.files())
      if (file.ends_with(".obj")) obj = program::content(place.path() / file);
    return lines_of(obj);
  };
  const auto count = [](const std::vector<std::string>& lines, const std::string& start) {
    return std::count_if(lines.begin(), lines.end(),
                         [&](const std::string& line) { return line.starts_with(start); });
  };
  const std::string quad = "<create dimension=\"2\"/><apply rule=\"create-quad\"/>";
  const auto star = build(quad + "<apply rule=\"star\" to=\"all\"/>");
  EXPECT_EQ(count(star, "v "), 5);
  EXPECT_EQ(count(star, "f "), 4);
  EXPECT_THAT(star, testing::Contains("v 0.5 0.5 0"));
  // Of two triangles, an edge of the border and the triangle there.
  const std::string two =
      "<create dimension=\"2\"/><apply rule=\"create-quad\"/><apply rule=\"halve-quad\" to=\"all\"/>";
  const auto cut = build(two + "<apply rule=\"cut-edge\" box=\"-0.1 0.9 -1 1.1 1.1 1\"/>");
  EXPECT_EQ(count(cut, "v "), 5);
  EXPECT_EQ(count(cut, "f "), 3);
  // One edge: that with its middle at p, or that with both ends in a box. The diagonal has two triangles.
  EXPECT_EQ(build(two + "<apply rule=\"cut-at\" p=\"point(0.5, 1, 0)\"/>"), cut);
  const auto inner = build(two + "<apply rule=\"cut-at\" p=\"point(0.5, 0.5, 0)\"/>");
  EXPECT_EQ(count(inner, "f "), 4);
  EXPECT_THAT(inner, testing::Contains("v 0.5 0.5 0"));
  // Of each of the four corners of two quads a triangle, and a quad in their middle.
  const auto halved = build("<sheet cells=\"2 1\" size=\"2 1\"/><apply rule=\"cut-in-half\" to=\"all\"/>");
  EXPECT_EQ(count(halved, "v "), 6 + 7);
  EXPECT_EQ(count(halved, "f "), 2 * 5);
  // Of 3 x 3 vertices the middle one goes to the mean of its neighbours, where it was; corners go inwards.
  const auto smooth = build("<sheet cells=\"2 2\" size=\"2 2\"/><apply rule=\"smooth\" to=\"all\" t=\"1\"/>");
  EXPECT_THAT(smooth, testing::Contains("v 0.5 0.5 0"));
  EXPECT_EQ(count(smooth, "v 1 1 0"), 1);
}

// What the page says of holes: a triangular hole in a closed surface is capped dart by dart.
TEST(RulePage, tells_enough_to_cap_a_hole) {
  const TestFolder place;
  place.write("mine.xml", R"(<rules>
  <rule name="cap" about="a triangle over a hole of three sides, with two triangles at each of its corners"
        left="a* b c d e f g h i j k l  a-1-b b-2-c c-1-d d-0-e e-1-f f-2-g g-1-h h-0-i i-1-j j-2-k k-1-l l-0-a
              a|2 d|2 e|2 h|2 i|2 l|2"
        right="a b c d e f g h i j k l  a-1-b b-2-c c-1-d d-0-e e-1-f f-2-g g-1-h h-0-i i-1-j j-2-k k-1-l l-0-a
               m n o p q r  m-1-n n-0-o o-1-p p-0-q q-1-r r-0-m  a-2-m d-2-n e-2-o h-2-p i-2-q l-2-r
               m|3 n|3 o|3 p|3 q|3 r|3"/>
</rules>)");
  place.write("s.xml", scene("<create dimension=\"2\"/><apply rule=\"create-tetrahedron\"/>"
                             "<apply rule=\"remove-inner-face\" box=\"-1 -1 -1 2 2 0.1\"/>"
                             "<apply rule=\"cap\" to=\"all\"/>"));
  ASSERT_EQ(place.rend("rule check mine.xml").code, 0) << place.rend("rule check mine.xml").err;
  const Outcome outcome = place.rend("run s.xml --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
}

} // namespace
} // namespace rend::rule_command_test
