// Every preset of tests/bad is refused by run and by render as its first line says, and no file is written.
//
//   <!-- expect CODE at LINE:COLUMN: words of the message or its hint -->
#include "render/files/png.h"
#include "tests/render/commands/program_run.h"
#include "tests/test_paths.h"

#include <regex>

namespace rend::bad_presets_test {
namespace {

using program::Outcome;
using program::TestFolder;
namespace fs = std::filesystem;

std::vector<fs::path> bad_presets() {
  std::vector<fs::path> all;
  for (const auto& entry : fs::directory_iterator(fs::path(test::source_root) / "tests/bad"))
    all.push_back(entry.path());
  std::sort(all.begin(), all.end());
  return all;
}

class BadPreset : public testing::TestWithParam<fs::path> {};

TEST_P(BadPreset, IsRefusedAsItsFirstLineSays) {
  const std::string text = program::content(GetParam()), first = text.substr(0, text.find('\n'));
  std::smatch expected;
  ASSERT_TRUE(std::regex_match(first, expected, std::regex("<!-- expect (\\d+) at (\\d+:\\d+): (.*) -->")))
      << first;
  const TestFolder place;
  place.write("bad.xml", text);
  std::vector<std::string> commands{"run bad.xml --diagnostics d.csv --events e.jsonl"};
  if (png_available()) commands.push_back("render bad.xml -o frames");
  for (const std::string& command : commands) {
    const Outcome outcome = place.rend(command);
    EXPECT_EQ(outcome.code, std::stoi(expected[1])) << command;
    EXPECT_EQ(outcome.err.rfind("rend: error: bad.xml:" + expected[2].str() + ": ", 0), 0U) << outcome.err;
    EXPECT_NE(outcome.err.find(expected[3]), std::string::npos) << outcome.err << "lacks: " << expected[3];
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(place.files(), std::vector<std::string>{"bad.xml"});
  }
}

INSTANTIATE_TEST_SUITE_P(All, BadPreset, testing::ValuesIn(bad_presets()), [](const auto& test) {
  std::string name = test.param.stem().string();
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

} // namespace
} // namespace rend::bad_presets_test
