// rend diff as a user runs it: states and exit codes, tolerances, reports, updates, and bad input.
#include "render/files/png.h"
#include "tests/render/commands/program_run.h"
#include "tests/render/needs.h"
#include "tests/render/pictures.h"
#include "tests/test_paths.h"

#include <gmock/gmock.h>
#include <map>
#include <set>

namespace rend::diff_command_test {
namespace {

using program::content;
using program::Outcome;
using program::TestFolder;
using testing::HasSubstr;
namespace fs = std::filesystem;

class Diff : public testing::Test {
protected:
  void SetUp() override {
    NEEDS_PNG;
    for (const char* folder : {"a", "b"}) fs::create_directories(place.path() / folder / "in");
  }
  void put(const std::string& name, const Image& image) const { write_png(place.path() / name, image); }
  void put_both(const std::string& name, const Image& image) const {
    put("a/" + name, image);
    put("b/" + name, image);
  }
  static Image picture(int seed = 0, int width = 40, int height = 30) {
    return test::pattern(width, height, 3, seed);
  }
  // A picture with one pixel slightly different.
  static Image touched(int by = 5) {
    Image image = picture();
    image.pixels[3 * (40 * 12 + 20) + 1] = static_cast<std::uint8_t>(image.pixels[3 * (40 * 12 + 20) + 1] + by);
    return image;
  }
  Outcome diff(const std::string& arguments) const { return place.rend("diff " + arguments); }
  std::map<std::string, std::string> states(const std::string& arguments, int code) const {
    const Outcome outcome = diff(arguments + " --json");
    EXPECT_EQ(outcome.code, code) << outcome.err;
    std::map<std::string, std::string> out;
    if (outcome.out.empty()) return out;
    const nlohmann::json report = outcome.json();
    for (const auto& one : report["cases"]) out[one["name"]] = one["state"];
    return out;
  }
  // Pictures with every state once.
  void make_all_states() const {
    put_both("in/match.png", picture());
    put("a/differ.png", picture());
    put("b/differ.png", touched());
    put("a/size.png", picture());
    put("b/size.png", picture(0, 41, 30));
    put("a/in/missing.png", picture());
    put("b/in/new.png", picture());
    put("a/torn.png", picture());
    place.write("b/torn.png", content(place.path() / "a/torn.png").substr(0, 90));
  }

  const TestFolder place;
};

TEST_F(Diff, tells_every_state_from_the_others) {
  make_all_states();
  const std::map<std::string, std::string> expected{{"in/match.png", "match"}, {"differ.png", "differ"},
                                                    {"size.png", "size"},      {"in/missing.png", "missing"},
                                                    {"in/new.png", "new"},     {"torn.png", "unreadable"}};
  EXPECT_EQ(states("a b", 2), expected);
}

TEST_F(Diff, ends_with_0_1_or_2_as_diff_does) {
  put_both("one.png", picture());
  EXPECT_EQ(diff("a b").code, 0);
  EXPECT_EQ(diff("a/one.png b/one.png").code, 0);
  put("b/in/new.png", picture());
  EXPECT_EQ(diff("a b").code, 1);
  fs::remove(place.path() / "b/in/new.png");
  put("b/one.png", touched());
  EXPECT_EQ(diff("a b").code, 1);
  put("b/one.png", picture(0, 30, 40));
  EXPECT_EQ(diff("a b").code, 1);
  place.write("b/one.png", "no picture");
  EXPECT_EQ(diff("a b").code, 2);
}

TEST_F(Diff, says_nothing_with_quiet_but_by_its_exit_code) {
  put("a/one.png", picture());
  put("b/one.png", touched());
  const Outcome outcome = diff("a b -q");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.out + outcome.err, "");
}

TEST_F(Diff, names_what_is_wrong_with_a_picture) {
  put("a/one.png", picture());
  const std::string whole = content(place.path() / "a/one.png");
  std::string flipped = whole;
  flipped[whole.size() / 2] = static_cast<char>(flipped[whole.size() / 2] ^ 0x40);
  const std::pair<std::string, std::string> bad[] = {{"", "empty"},
                                                     {"some text", "not a PNG file"},
                                                     {"\xff\xd8\xff\xe0 JFIF", "JPEG"},
                                                     {whole.substr(0, 4), "not a PNG file"},
                                                     {whole.substr(0, whole.size() / 2), "cut off"},
                                                     {whole.substr(0, whole.size() - 12), "cut off"},
                                                     {flipped, "cannot be read"}};
  for (const auto& [bytes, word] : bad) {
    place.write("b/one.png", bytes);
    const Outcome outcome = diff("a/one.png b/one.png");
    EXPECT_EQ(outcome.code, 2) << word;
    EXPECT_THAT(outcome.out, HasSubstr("unreadable"));
    EXPECT_THAT(outcome.out, HasSubstr("b/one.png: "));
    EXPECT_THAT(outcome.out, HasSubstr(word));
  }
}

TEST_F(Diff, of_two_equal_files_that_are_no_pictures_is_unreadable) {
  place.write("a/one.png", "nothing");
  place.write("b/one.png", "nothing");
  EXPECT_EQ(diff("a b").code, 2);
}

TEST_F(Diff, does_not_believe_a_file_that_claims_a_huge_picture) {
  put_both("one.png", picture());
  std::string bytes = content(place.path() / "a/one.png");
  bytes.replace(16, 8, std::string("\0\1\0\0\0\1\0\0", 8)); // 65536 x 65536; the CRC is wrong as well
  place.write("b/one.png", bytes);
  EXPECT_EQ(diff("a b").code, 2);
}

TEST_F(Diff, refuses_what_cannot_be_compared) {
  put_both("one.png", picture());
  const Outcome mixed = diff("a b/one.png");
  EXPECT_EQ(mixed.code, 2);
  EXPECT_THAT(mixed.err, HasSubstr("folder cannot be compared with a file"));
  EXPECT_THAT(mixed.err, HasSubstr("a/one.png"));
  fs::create_directories(place.path() / "empty");
  EXPECT_EQ(diff("empty empty").code, 2);
  EXPECT_EQ(diff("a empty").code, 1); // missing
  EXPECT_EQ(diff("empty a").code, 1); // new
  EXPECT_EQ(diff("a nowhere").code, 66);
  EXPECT_EQ(diff("nowhere.png a/one.png").code, 66);
  EXPECT_EQ(diff("a").code, 64);
  EXPECT_EQ(diff("a b --limit shore=1").code, 64);
  EXPECT_THAT(diff("a b --limit shore=1").err, HasSubstr("share"));
  EXPECT_EQ(diff("a b --limit share=2").code, 64);
  EXPECT_EQ(diff("a b --limit share").code, 64);
  EXPECT_EQ(diff("a b --json --json-lines").code, 64);
  place.write("file", "");
  EXPECT_EQ(diff("a b -o file/report").code, 73);
}

TEST_F(Diff, follows_links_to_folders_and_refuses_those_that_lead_back) {
  put_both("one.png", picture());
  put("a/in/two.png", picture());
  put("b/in/two.png", touched());
  for (const char* side : {"a", "b"}) { // the folders that differ lie elsewhere and are reached through links
    fs::rename(place.path() / side / "in", place.path() / (side + std::string("-in")));
    fs::create_directory_symlink("../" + std::string(side) + "-in", place.path() / side / "sub");
    // a second link to a folder is not a cycle
    fs::create_directory_symlink("sub", place.path() / side / "again");
  }
  const std::map<std::string, std::string> expected{
      {"one.png", "match"}, {"sub/two.png", "differ"}, {"again/two.png", "differ"}};
  EXPECT_EQ(states("a b", 1), expected);
  const Outcome elsewhere = diff("a b --update sub --update again");
  EXPECT_EQ(elsewhere.code, 2) << "what lies elsewhere is compared, and not changed";
  EXPECT_THAT(elsewhere.err, HasSubstr("a link leads from the expected pictures to"));
  EXPECT_EQ(states("a b", 1), expected);
  fs::create_directory_symlink("../b", place.path() / "b-in/back");
  const Outcome outcome = diff("a b");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("back"));
  EXPECT_THAT(outcome.err, HasSubstr("leads back"));
}

TEST_F(Diff, takes_limits_from_the_command_line) {
  put("a/one.png", picture());
  put("b/one.png", touched(5));
  EXPECT_EQ(diff("a b --limit max=4").code, 1);
  EXPECT_EQ(diff("a b --limit max=5").code, 0);
  EXPECT_EQ(diff("a b --limit share=0.001").code, 0); // 1 of 1200
  EXPECT_EQ(diff("a b --limit share=0.0001").code, 1);
  EXPECT_EQ(diff("a b --limit share=0 --limit threshold=5").code, 0);
  EXPECT_EQ(diff("a b --limit window=0.003").code, 1); // 1 of 256
  EXPECT_EQ(diff("a b --limit psnr=200").code, 1);
  EXPECT_EQ(diff("a b --limit ssim=1").code, 1);
  EXPECT_EQ(diff("a b --limit max=255 --limit flip-max=0").code, 1);
}

TEST_F(Diff, takes_any_as_no_limit_and_not_as_equality) {
  put("a/one.png", picture());
  put("b/one.png", touched(5));
  for (const char* limit : {"max=any", "share=any"}) {
    const Outcome outcome = diff(std::string("a b --json --limit ") + limit);
    EXPECT_EQ(outcome.code, 0) << limit;
    EXPECT_TRUE(outcome.json()["cases"][0]["limits"].empty());
  }
  EXPECT_EQ(diff("a b --limit max=any --limit flip-max=0").code, 1); // another limit still holds
  EXPECT_EQ(diff("a b --limit max=any --limit max=4").code, 1);
  place.write("t.xml", R"(<tolerances><default max="any"/><case name="in/*" max="0"/></tolerances>)");
  put("a/in/two.png", picture());
  put("b/in/two.png", touched(5));
  const auto found = states("a b -t t.xml", 1);
  EXPECT_EQ(found.at("one.png"), "match");
  EXPECT_EQ(found.at("in/two.png"), "differ");
  put("b/one.png", picture(0, 8, 8));
  EXPECT_EQ(diff("a/one.png b/one.png --limit max=any").code, 1); // the size cannot be tolerated
  EXPECT_EQ(diff("a/in b/in --json").json()["cases"][0]["limits"], nlohmann::json({{"max", 0}}));
}

TEST_F(Diff, notes_thresholds_that_nothing_is_measured_by) {
  put("a/one.png", picture());
  put("b/one.png", touched(5));
  const Outcome idle = diff("a b --limit threshold=255 --limit window-size=8");
  EXPECT_EQ(idle.code, 1);
  EXPECT_THAT(idle.err, HasSubstr("--limit gives a threshold, which has no effect"));
  EXPECT_THAT(idle.err, HasSubstr("--limit gives a window-size, which has no effect"));
  EXPECT_EQ(diff("a b --limit threshold=255 --limit window-size=8 --limit window=0").err, "");
  EXPECT_THAT(diff("a b --limit window-size=8 --limit share=0").err, HasSubstr("window-size"));
  place.write("t.xml",
              "<tolerances>\n <default threshold=\"9\"/>\n <case name=\"two*\" share=\"0\"/></tolerances>");
  put_both("one.png", picture());
  EXPECT_THAT(diff("a b -t t.xml").err, HasSubstr("t.xml:2:"));
  put_both("two.png", picture());
  EXPECT_EQ(diff("a b -t t.xml").err, "");
}

TEST_F(Diff, takes_tolerances_by_picture_from_a_file) {
  for (const char* name : {"one.png", "in/one.png", "in/two.png"}) {
    put("a/" + std::string(name), picture());
    put("b/" + std::string(name), touched(5));
  }
  Image mask = picture();
  std::fill(mask.pixels.begin(), mask.pixels.end(), std::uint8_t{255});
  for (std::size_t c = 0; c < 3; ++c) mask.pixels[3 * (40 * 12 + 20) + c] = 0;
  put("mask.png", mask);
  place.write("t.xml", R"(<tolerances>
  <default max="3"/>
  <case name="in/*" max="5"/>
  <case name="in/two*" mask="mask.png" max="0"/>
  <case name="fig-7.*" max="any"/>
</tolerances>)");
  const auto found = states("a b --tolerances t.xml", 1);
  EXPECT_EQ(found.at("one.png"), "differ");
  EXPECT_EQ(found.at("in/one.png"), "match");
  EXPECT_EQ(found.at("in/two.png"), "match");
  EXPECT_THAT(diff("a b -t t.xml").err, HasSubstr("fig-7.*")); // matches nothing
  EXPECT_EQ(diff("a b -t t.xml --limit max=5").code, 0);       // the command line overrides the file
  EXPECT_EQ(diff("a b --mask mask.png").code, 0);
}

TEST_F(Diff, refuses_bad_tolerances_with_their_place) {
  put_both("one.png", picture());
  place.write("bad.xml", "<tolerances>\n  <default shore=\"1\"/>\n</tolerances>");
  const Outcome outcome = diff("a b --tolerances bad.xml");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("bad.xml:2:"));
  EXPECT_THAT(outcome.err, HasSubstr("share"));
  EXPECT_EQ(diff("a b --tolerances none.xml").code, 66);
  put("small.png", picture(0, 8, 8));
  const Outcome small = diff("a b --mask small.png");
  EXPECT_EQ(small.code, 2);
  EXPECT_THAT(small.out, HasSubstr("8 x 8")); // of this pair
}

TEST_F(Diff, writes_a_page_maps_json_and_junit) {
  make_all_states();
  const Outcome outcome = diff("a b -o report --junit j.xml --json");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(content(place.path() / "report/diff.json"), outcome.out);
  EXPECT_EQ(outcome.json()["counts"]["differ"], 1);
  const Image map = read_png(place.path() / "report/maps/differ.png");
  EXPECT_EQ(map.width, 40);
  const std::string page = content(place.path() / "report/index.html");
  EXPECT_LT(page.find("torn.png"), page.find("differ.png"));
  EXPECT_LT(page.find("differ.png"), page.find("in/match.png"));
  for (const char* away : {"src=\"http", "href=\"http", "@import", "url(", "<link"})
    EXPECT_EQ(page.find(away), std::string::npos) << away;
  EXPECT_EQ(place.shell("xmllint --noout report/index.html").code, 0);
  EXPECT_EQ(place.shell("xmllint --noout j.xml").code, 0);
  EXPECT_EQ(place.shell("xmllint --xpath 'count(//testcase)' j.xml").out, "6\n");
  EXPECT_EQ(place.shell("xmllint --xpath 'count(//failure)' j.xml").out, "4\n");
  EXPECT_EQ(place.shell("xmllint --xpath 'count(//error)' j.xml").out, "1\n");
  EXPECT_EQ(place.shell("xmllint --xpath 'string(//testsuite/@failures)' j.xml").out, "4\n");
}

TEST_F(Diff, gives_the_same_bytes_on_any_number_of_threads) {
  make_all_states();
  diff("a b -o one --threads 1 -q");
  diff("a b -o four --threads 4 -q");
  EXPECT_EQ(content(place.path() / "one/index.html"), content(place.path() / "four/index.html"));
  EXPECT_EQ(content(place.path() / "one/diff.json"), content(place.path() / "four/diff.json"));
}

TEST_F(Diff, writes_one_line_of_json_a_picture_in_their_order) {
  make_all_states();
  std::istringstream lines(diff("a b --json-lines").out);
  std::vector<std::string> names;
  for (std::string line; std::getline(lines, line);) names.push_back(nlohmann::json::parse(line)["name"]);
  EXPECT_THAT(names, testing::ElementsAre("differ.png", "in/match.png", "in/missing.png", "in/new.png",
                                          "size.png", "torn.png"));
}

TEST_F(Diff, updates_the_named_pictures_alone) {
  make_all_states();
  const std::string before = content(place.path() / "a/size.png");
  EXPECT_EQ(diff("a b --update differ --update in/new.png").code, 2);
  EXPECT_EQ(content(place.path() / "a/differ.png"), content(place.path() / "b/differ.png"));
  EXPECT_EQ(content(place.path() / "a/in/new.png"), content(place.path() / "b/in/new.png"));
  EXPECT_EQ(content(place.path() / "a/size.png"), before);
  EXPECT_EQ(states("a b", 2).at("differ.png"), "match");
}

// A picture that cannot be read hinders no other; a missing one is not expected any more.
TEST_F(Diff, updates_by_patterns_what_there_is_and_what_there_is_not) {
  make_all_states();
  EXPECT_EQ(diff("a b --update torn 'in/*'").code, 2);
  EXPECT_FALSE(fs::exists(place.path() / "a/in/missing.png"));
  EXPECT_EQ(content(place.path() / "a/in/new.png"), content(place.path() / "b/in/new.png"));
  EXPECT_NE(content(place.path() / "a/differ.png"), content(place.path() / "b/differ.png"));
  const Outcome all = diff("a b --update '*' --json");
  EXPECT_EQ(all.code, 2) << "torn.png stays";
  EXPECT_EQ(all.json()["counts"]["unreadable"], 1);
  EXPECT_EQ(all.json()["counts"]["updated"], 2); // differ, size
  fs::remove(place.path() / "b/torn.png");
  EXPECT_EQ(diff("a b --update '*'").code, 0);
  EXPECT_EQ(diff("a b").code, 0);
}

TEST_F(Diff, never_removes_all_that_is_expected) {
  put("a/one.png", picture());
  fs::create_directories(place.path() / "b");
  const Outcome outcome = diff("a b --update '*'");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("would remove every expected picture"));
  EXPECT_TRUE(fs::exists(place.path() / "a/one.png"));
}

TEST_F(Diff, tells_of_a_clip_its_first_and_its_worst_frame) {
  for (const char* side : {"a", "b"}) fs::create_directories(place.path() / side / "bowl");
  for (int n = 0; n < 5; ++n) {
    put("a/bowl/0000" + std::to_string(n) + ".png", picture());
    put("b/bowl/0000" + std::to_string(n) + ".png", n < 2 ? picture() : touched(n));
  }
  const Outcome outcome = diff("a b --json");
  const nlohmann::json report = outcome.json(), clip = report["clips"][0];
  EXPECT_EQ(clip["name"], "bowl");
  EXPECT_EQ(clip["frames"], 5);
  EXPECT_EQ(clip["first"], "bowl/00002.png");
  double most = 0;
  std::string worst;
  for (const auto& one : report["cases"])
    if (one["figures"]["flip"]["mean"] > most) {
      most = one["figures"]["flip"]["mean"];
      worst = one["name"];
    }
  EXPECT_EQ(clip["worst"], worst);
  EXPECT_EQ(clip["curve"][0]["flip"], 0);
  EXPECT_THAT(diff("a b").out, HasSubstr("bowl: 5 frames; the first that does not match is bowl/00002.png"));
  EXPECT_EQ(diff("a b --update '*' -o page").code, 0);
  EXPECT_THAT(content(place.path() / "page/index.html"), HasSubstr("<svg class=\"curve\""));
}

TEST_F(Diff, writes_reports_for_gitlab_and_github) {
  make_all_states();
  EXPECT_EQ(diff("a b --gitlab quality.json --github annotations.txt").code, 2);
  const nlohmann::json issues = nlohmann::json::parse(content(place.path() / "quality.json"));
  EXPECT_EQ(issues.size(), 5u);
  std::set<std::string> prints;
  for (const auto& one : issues) {
    prints.insert(one["fingerprint"]);
    EXPECT_TRUE(one["location"]["lines"]["begin"] == 1 && one["location"]["path"].is_string()) << one;
  }
  EXPECT_EQ(prints.size(), issues.size());
  const std::string lines = content(place.path() / "annotations.txt");
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 5);
  EXPECT_THAT(
      lines,
      HasSubstr("::error file=a/differ.png,title=rend diff%3A differ::differ.png: max 5, at most 0 levels"));
}

// One column of an edge lies between its sides: smoothed in one picture, sharp in the other.
TEST_F(Diff, leaves_out_smoothed_edges_only_where_it_is_asked_to) {
  Image sharp(24, 24), smooth(24, 24), moved(24, 24);
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 24; ++x)
      for (int c = 0; c < 3; ++c) {
        sharp.row(y)[3 * x + c] = x < 12 ? 20 : 220;
        smooth.row(y)[3 * x + c] = x + y / 2 < 18    ? 20
                                   : x + y / 2 == 18 ? static_cast<std::uint8_t>(100 + y)
                                                     : 220;
        moved.row(y)[3 * x + c] = x < 15 ? 20 : 220;
      }
  Image other = smooth; // the same edge, smoothed by other weights
  for (int y = 0; y < 24; ++y)
    for (int c = 0; c < 3; ++c)
      if (const int x = 18 - y / 2; x >= 0) other.row(y)[3 * x + c] = static_cast<std::uint8_t>(140 - y);
  put("a/edge.png", smooth);
  put("b/edge.png", other);
  EXPECT_EQ(diff("a b").code, 1);
  const Outcome outcome = diff("a b --limit antialiased=ignore --limit max=0 --json");
  EXPECT_EQ(outcome.code, 0) << outcome.out;
  EXPECT_THAT(outcome.json()["cases"][0]["notes"].dump(), HasSubstr("left out as smoothed edges"));
  put("a/edge.png", sharp);
  put("b/edge.png", moved);
  EXPECT_EQ(diff("a b --limit antialiased=ignore --limit max=0").code, 1) << "an edge that has moved counts";
}

TEST_F(Diff, updates_all_that_is_named_or_nothing) {
  make_all_states();
  const std::string before = content(place.path() / "a/differ.png");
  EXPECT_EQ(diff("a b --update differ --update nothing").code, 64); // no such case
  EXPECT_EQ(diff("a b --update").code, 64);
  EXPECT_EQ(content(place.path() / "a/differ.png"), before);
  // A limit on file size simulates a full disk: 512 bytes.
  Image noise(40, 30);
  for (std::size_t n = 0; n < noise.pixels.size(); ++n)
    noise.pixels[n] = static_cast<std::uint8_t>(n * n * n >> 5);
  put("b/differ.png", noise);
  const Outcome full = place.shell("ulimit -f 1; trap '' XFSZ; " + std::string(test::rend_program) +
                                   " diff a b --update differ --update size -q");
  EXPECT_EQ(full.code, 74);
  EXPECT_EQ(content(place.path() / "a/differ.png"), before);
  for (const std::string& name : place.files()) EXPECT_FALSE(name.ends_with(".part")) << name;
}

TEST_F(Diff, updates_more_pictures_than_files_can_be_open) {
  put("a/one.png", picture());
  put("b/one.png", touched());
  for (int n = 0; n < 100; ++n)
    for (const char* side : {"a", "b"})
      fs::copy_file(place.path() / side / "one.png", place.path() / side / "in" / (std::to_string(n) + ".png"));
  const Outcome outcome =
      place.shell("ulimit -n 40; " + std::string(test::rend_program) + " diff a b --update in -q");
  EXPECT_EQ(outcome.code, 1) << outcome.err; // one.png
  EXPECT_EQ(diff("a/in b/in").code, 0);
  EXPECT_EQ(place.files().size(), 2 * 103u); // nothing is left behind
}

TEST_F(Diff, updates_a_file_that_has_two_names_once) {
  put("a/in/one.png", picture());
  fs::create_directory_symlink("in", place.path() / "a/same");
  put("b/in/one.png", touched(1));
  fs::create_directories(place.path() / "b/same");
  put("b/same/one.png", touched(2));
  const std::string before = content(place.path() / "a/in/one.png");
  const Outcome outcome = diff("a b --update in --update same");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("two names"));
  EXPECT_EQ(content(place.path() / "a/in/one.png"), before);
  put("b/same/one.png", touched(1));
  EXPECT_EQ(diff("a b --update in --update same").code, 0);
  EXPECT_EQ(diff("a b").code, 0);
}

TEST_F(Diff, knows_that_its_reports_can_be_written_before_it_compares_or_updates) {
  put("a/one.png", picture());
  put("b/one.png", touched());
  const std::string before = content(place.path() / "a/one.png");
  place.write("file", "");
  fs::create_directories(place.path() / "taken/index.html");
  fs::create_directories(place.path() / "folder");
  for (const char* bad : {"-o file", "-o file/report", "-o taken", "--junit nowhere/j.xml", "--junit folder",
                          "-o report --junit nowhere/j.xml"}) {
    const Outcome outcome = diff("a b --json-lines --update one " + std::string(bad));
    EXPECT_EQ(outcome.code, 73) << bad;
    EXPECT_EQ(diff("a b --json-lines " + std::string(bad)).out, "") << bad; // nothing was compared
    EXPECT_EQ(content(place.path() / "a/one.png"), before) << bad;
    // created, and removed again since it stayed empty
    EXPECT_FALSE(fs::exists(place.path() / "report")) << bad;
  }
  for (const std::string& name : place.files()) EXPECT_FALSE(name.ends_with(".part")) << name;
}

TEST_F(Diff, takes_names_with_anything_in_them) {
  put_both("a <b> & \"c\".png", picture());
  put("b/caf\xe9.png", picture());
  EXPECT_EQ(diff("a b -o report --junit j.xml --json").code, 1);
  EXPECT_EQ(place.shell("xmllint --noout report/index.html j.xml").code, 0);
}

} // namespace
} // namespace rend::diff_command_test
