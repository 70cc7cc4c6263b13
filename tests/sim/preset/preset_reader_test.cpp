#include "sim/preset/preset_reader.h"

#include "tests/sim/preset/reading.h"

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

namespace rend::preset_reader_test {
namespace {

namespace fs = std::filesystem;
using namespace small_table;

class Folder {
public:
  Folder() : path_(fs::temp_directory_path() / ("rend-presets-" + std::to_string(std::random_device()()))) {
    fs::create_directory(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return (path_ / name).string();
  }
  const fs::path& path() const { return path_; }

private:
  fs::path path_;
};

TEST(PresetReader, ReadsAPreset) {
  const auto root = read(preset);
  EXPECT_EQ(root->text("name"), "small");
  ASSERT_EQ(root->all("body").size(), 2U);
  const PresetNode& left = *root->all("body")[0];
  EXPECT_EQ(left.child("sheet")->numbers("size"), (std::vector<double>{1, 2}));
  EXPECT_EQ(left.child("springs")->child("stretch")->number("k"), 60);
  EXPECT_EQ(left.all("tear").size(), 2U);
  EXPECT_EQ(root->child("time")->number("step"), 1e-3);
  EXPECT_EQ(root->child("hud"), nullptr);
}

TEST(PresetReader, FillsDefaults) {
  const auto root = read(preset);
  const PresetNode& stretch = *root->child("body")->child("springs")->child("stretch");
  EXPECT_EQ(stretch.number("damping"), 0);
  EXPECT_FALSE(stretch.given("damping"));
  EXPECT_EQ(root->child("map")->child("look")->text("by"), "plain");
}

TEST(PresetReader, KnowsWhereElementsAndValuesStand) {
  const auto root = read(preset);
  const PresetNode& sheet = *root->child("body")->child("sheet");
  EXPECT_EQ(sheet.place().text(), "p.xml:5:5");
  EXPECT_EQ(sheet.place("cells").text(), "p.xml:5:19");
  EXPECT_EQ(sheet.place("size").text(), "p.xml:6:18");
  EXPECT_EQ(root->all("body")[1]->child("sheet")->place("cells").text(), "p.xml:12:36");
}

TEST(PresetReader, CountsColumnsInCharactersAndLinesOfAnySystem) {
  // The é is two bytes; a byte order mark has no column; three kinds of line ends; '>' and "'" in values.
  const auto root = read("\xEF\xBB\xBF<scene name='é>\"'  version = \n '1'>\r\n<body \r name=\"it's\"\n>"
                         "<sheet cells='1 1'/></body></scene>");
  EXPECT_EQ(root->place().text(), "p.xml:1:1");
  EXPECT_EQ(root->place("name").text(), "p.xml:1:14");
  EXPECT_EQ(root->place("version").text(), "p.xml:2:3");
  EXPECT_EQ(root->child("body")->place("name").text(), "p.xml:4:8");
  EXPECT_EQ(root->child("body")->child("sheet")->place("cells").text(), "p.xml:5:16");
  EXPECT_EQ(root->child("body")->text("name"), "it's");
}

TEST(PresetReader, KnowsCharacterReferences) {
  EXPECT_EQ(read(changed("name=\"left\"", "name=\"&lt;&#65;&amp;\""))->child("body")->text("name"), "<A&");
}

TEST(PresetReader, PointsAtABadValue) {
  EXPECT_EQ(
      refused(changed("size=\"1 2\"", "size=\"1 x\"")),
      "p.xml:6:18: size of <sheet> is '1 x', where 'x' is not a number; expected 2 numbers, each above 0 [m]");
  expect_starts(refused(changed("k=\"60\"", "k=\"1e999\"")), "p.xml:7:42: k of <stretch> is '1e999'");
}

TEST(PresetReader, RefusesUnknownElementsWithTheNearestName) {
  EXPECT_EQ(refused(changed("<stretch k=\"60\"/>", "<strech k=\"60\"/>")),
            "p.xml:7:30: there is no <strech> in <springs> | did you mean 'stretch'? in <springs> may stand: "
            "stretch");
  expect_starts(
      refused(changed("<stretch k=\"60\"/>", "<texture file=\"a.png\"/>")),
      "p.xml:7:30: there is no <texture> in <springs> | there is none: a <look> gives a body one colour");
  EXPECT_THAT(refused(changed("k=\"60\"", "opacity=\"0.5\"")), testing::HasSubstr("bodies are opaque"));
  EXPECT_EQ(refused(changed("<time ", "<tear ")),
            "p.xml:13:3: there is no <tear> in <scene> | it belongs in <body>. in <scene> may stand: "
            "body, time, hud, camera, map");
  EXPECT_EQ(refused(changed("<key at=\"1\"/>", "<key at=\"1\"><sheet/></key>")),
            "p.xml:14:35: there is no <sheet> in <key> | it belongs in <body>. <key> holds no elements");
}

TEST(PresetReader, RefusesUnknownAttributesWithTheNearestName) {
  EXPECT_EQ(refused(changed("size=\"1 2\"", "sise=\"1 2\"")),
            "p.xml:6:12: <sheet> has no attribute 'sise' | did you mean 'size'? <sheet> has: cells, size");
  EXPECT_EQ(refused(changed("<map>", "<map a='1'>")),
            "p.xml:15:8: <map> has no attribute 'a' | <map> has no attributes");
}

TEST(PresetReader, RefusesAnotherRoot) {
  EXPECT_EQ(refused("<body/>"), "p.xml:1:1: a preset begins with <scene>, not with <body>");
}

TEST(PresetReader, RefusesWhatIsNotWellFormed) {
  expect_starts(refused(changed("k=\"60\"", "k=\"60\" k=\"61\"")),
                "p.xml:7:46: the attribute 'k' is given twice");
  expect_starts(refused(changed("</springs>", "</spring>")), "p.xml:7:49: </spring> where <springs> of line 7");
  expect_starts(refused(std::string(preset) + "<scene/>"), "p.xml:17:1: after </scene> nothing may stand");
  expect_starts(refused(std::string(preset) + "text"), "p.xml:17:1: after </scene> nothing may stand");
  expect_starts(refused(changed("cells=\"4 4\"", "cells=4")), "p.xml:5:18: this is not XML: not well-formed");
  expect_starts(refused(changed("name=\"left\"", "name=\"&lt;&left;\"")),
                "p.xml:4:19: the entity '&left;' is not known");
  expect_starts(refused(""), "p.xml:1:1: there is nothing in this preset");
  expect_starts(refused("<!-- nothing -->\n"), "p.xml:2:1: there is nothing in this preset");
  expect_starts(refused("a text"), "p.xml:1:1: this is not XML");
  expect_starts(refused("<scene name='x'>\n<body>"),
                "p.xml:2:7: this is not closed where the file ends | <body> of "
                "line 2 is open as well");
  expect_starts(refused("<scene name='x'>\n <body na"), "p.xml:2:2: this is not closed where the file ends");
  expect_starts(refused("<scene><body></scene></body>"), "p.xml:1:16: </scene> where <body> of line 1");
}

TEST(PresetReader, RefusesTextBetweenElements) {
  EXPECT_EQ(
      refused(changed("<map>", "<map>\n  a legend ")),
      "p.xml:16:3: stray text 'a legend' in <map> | values are given as attributes, such as name=\"value\"");
  expect_starts(refused(changed("<map>", "<map><![CDATA[ x]]>")), "p.xml:15:18: stray text 'x' in <map>");
  expect_starts(refused(changed("<map>", "<map>&#65;")), "p.xml:15:8: stray text 'A' in <map>");
}

TEST(PresetReader, RefusesDoctypesAndEntities) {
  std::string laughs = "<!DOCTYPE scene [\n<!ENTITY a0 \"ha\">\n";
  for (int i = 1; i < 40; ++i) {
    const std::string below = "&a" + std::to_string(i - 1) + ";";
    laughs += "<!ENTITY a" + std::to_string(i) + " \"" + below + below + "\">\n";
  }
  laughs += "]>\n<scene name=\"&a39;\"/>";
  EXPECT_EQ(refused(laughs),
            "p.xml:1:1: a preset may have no DOCTYPE and no entities of its own | take the DOCTYPE out");
  expect_starts(refused("<?xml version='1.0'?>\n <!DOCTYPE scene SYSTEM 'scene.dtd'>\n<scene/>"),
                "p.xml:2:2: a preset may have no DOCTYPE");
}

TEST(PresetReader, RefusesWhatIsNotUtf8) {
  const std::string latin = refused(changed("name=\"left\"", "name=\"\xE9t\xE9\""));
  expect_starts(latin, "p.xml:4:15: this is not XML");
  EXPECT_NE(latin.find("| a preset is a text in UTF-8"), std::string::npos);
  expect_starts(refused("<?xml version='1.0' encoding='ISO-8859-1'?><scene/>"),
                "p.xml:1:1: the encoding 'ISO-8859-1' is not read");
  expect_starts(refused(std::string("\xFF\xFE<\0s\0", 6)), "p.xml:1:1: this is not UTF-8 text");
  expect_starts(refused(std::string("<\0s\0/\0>\0", 8)), "p.xml:1:1: this is not UTF-8 text");
  expect_starts(refused(std::string("<scene name='a\0b'/>", 19)), "p.xml:1:15: this is not XML");
}

TEST(PresetReader, NamesWhatIsMissingOrTooMuch) {
  EXPECT_EQ(refused("<scene name='x'/>"),
            "p.xml:1:1: <scene> needs a <body> and has none | add <body>: A body.");
  expect_starts(refused(changed(" k=\"60\"", "")),
                "p.xml:7:30: <stretch> needs k | k: stiffness; expected a number");
  EXPECT_EQ(refused(changed("<map>", "<time/><map>")),
            "p.xml:15:3: <scene> may hold only 1 <time> | the first is at p.xml:13:3");
}

TEST(PresetReader, RefusesAnotherVersion) {
  EXPECT_EQ(refused(changed("version=\"1\">", "version=\"2\">")),
            "p.xml:3:30: the preset is of version '2', and this program reads version 1");
  EXPECT_EQ(read(changed(" version=\"1\">", ">"))->text("version"), "1");
}

TEST(PresetReader, LetsTheRootNameItsSchema) {
  EXPECT_NO_THROW(read(changed("<scene ", "<scene xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" "
                                          "xsi:noNamespaceSchemaLocation=\"scene.xsd\" ")));
  expect_starts(refused(changed("<map>", "<map xmlns:xsi='x'>")), "p.xml:15:8: <map> has no attribute");
}

TEST(PresetReader, ReadsAFile) {
  const Folder folder;
  EXPECT_EQ(read_preset(folder.write("a.xml", preset), scene)->text("name"), "small");
}

TEST(PresetReader, SaysWhichFilesAreNearOneThatIsMissing) {
  const Folder folder;
  folder.write("cloth.xml", preset);
  folder.write("notes.txt", "");
  const auto missing = [&](const std::string& name) {
    return refusal(Exit::NoInput, [&] { read_preset(folder.path() / name, scene); });
  };
  const std::string at = (folder.path() / "cloht.xml").string();
  EXPECT_EQ(missing("cloht.xml"),
            at + ": there is no such file | did you mean '" + (folder.path() / "cloth.xml").string() + "'?");
  EXPECT_NE(missing("cloth").find("did you mean"), std::string::npos);
  EXPECT_NE(missing("something.xml").find("presets in '" + folder.path().string() + "': cloth.xml"),
            std::string::npos);
  EXPECT_NE(missing("nowhere/a.xml").find("there is no folder"), std::string::npos);
}

TEST(PresetReader, RefusesAFolderAndAHugeFile) {
  const Folder folder;
  folder.write("cloth.xml", preset);
  EXPECT_EQ(refusal(Exit::NoInput, [&] { read_preset(folder.path(), scene); }),
            folder.path().string() + ": this is a folder, and a preset is a file | presets in it: cloth.xml");
  const std::string huge = folder.write("huge.xml", std::string(max_preset_bytes + 1, ' '));
  expect_starts(refusal(Exit::BadInput, [&] { read_preset(huge, scene); }), huge + ": has more than 16 MiB");
}

TEST(PresetReader, IsQuickOnOneLongLine) {
  std::string text = "<scene name='x'><body><sheet cells='1 1'/>";
  for (int i = 0; i < 20'000; ++i) text += "<tear threshold='1'/>";
  const auto root = read(text + "</body></scene>");
  EXPECT_EQ(root->child("body")->all("tear").back()->place("threshold").column, 43 + 19'999 * 21 + 17);
}

// Flipped bytes, truncations and duplicated lines: a preset is read, or refused with a UserError, and nothing
// else.
std::string mutated(std::mt19937& random) {
  std::string text = preset;
  const auto below = [&](std::size_t n) { return n == 0 ? 0 : random() % n; };
  for (std::size_t times = 1 + below(4); times > 0 && !text.empty(); --times) {
    const std::size_t at = below(text.size());
    const std::size_t line = text.rfind('\n', at) == std::string::npos ? 0 : text.rfind('\n', at) + 1;
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    switch (below(6)) {
    case 0:
      text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
      break;
    case 1:
      text[at] = static_cast<char>(below(256));
      break;
    case 2:
      text.resize(at);
      break;
    case 3:
      text.insert(line, text.substr(line, end - line));
      break;
    case 4:
      text.erase(at, below(20));
      break;
    default:
      text[at] = "<>\"'=&/! .-+0e[]"[below(16)];
      break;
    }
  }
  return text;
}

TEST(PresetReader, ReadsOrRefusesWhateverItIsGiven) {
  // the same numbers on every platform, since below() uses no distribution of the library
  std::mt19937 random(20240229);
  int good = 0;
  for (int i = 0; i < 2000; ++i) {
    const std::string text = mutated(random);
    try {
      read(text, {"time.step=2"});
      ++good;
    } catch (const UserError& error) {
      EXPECT_TRUE(error.code == Exit::BadInput || error.code == Exit::Usage) << text;
      EXPECT_GT(std::string(error.what()).size(), 10U);
    } catch (const std::exception& error) {
      FAIL() << error.what() << " for\n" << text;
    }
  }
  EXPECT_GT(good, 50);
  EXPECT_LT(good, 1950);
}

} // namespace
} // namespace rend::preset_reader_test
