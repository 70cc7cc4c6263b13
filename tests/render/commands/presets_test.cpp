// Every shipped preset: it loads, runs, tears if it has a tearing law, is referred to somewhere, and gives the
// same bytes.
#include "render/picture/scene_preset.h"
#include "sim/base/simd_width.h"
#include "tests/render/commands/program_run.h"
#include "tests/render/needs.h"
#include "tests/test_paths.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <gmock/gmock.h>
#include <iterator>
#include <set>
#include <sstream>

namespace rend::presets_test {
namespace {

using program::content;
using program::Outcome;
using program::TestFolder;
namespace fs = std::filesystem;

const fs::path root = test::source_root;

// Whether it needs the brightness of a picture, which a build without PNG cannot read.
bool is_masked(const fs::path& preset) {
  return content(preset).find(" picture=\"") != std::string::npos;
}

// Paths without folder and extension: "tear/moebius".
std::vector<std::string> all_presets() {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(root / "presets"))
    if (entry.path().extension() == ".xml" && (png_available() || !is_masked(entry.path())))
      names.push_back(fs::relative(entry.path(), root / "presets").replace_extension().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> presets_with_laws() {
  std::vector<std::string> names = all_presets();
  std::erase_if(names, [](const std::string& name) {
    const std::string text = content(root / "presets" / (name + ".xml"));
    return text.find("<tear ") == std::string::npos;
  });
  return names;
}

class EveryPreset : public testing::TestWithParam<std::string> {
protected:
  const fs::path path = root / "presets" / (GetParam() + ".xml");
  const TestFolder place;

  // `environment`: variables before the command.
  nlohmann::json run(const std::string& options, const std::string& environment = "") const {
    const Outcome outcome = place.shell(environment + " " + std::string(test::rend_program) + " run '" +
                                        path.string() + "' --json --quiet " + options);
    EXPECT_LE(outcome.code, 1) << outcome.err; // 1: an answer is not satisfied, as its time is not reached
    return outcome.code <= 1 ? outcome.json() : nlohmann::json();
  }
  std::string tenth() const {
    const auto scene = load_scene(path);
    return "--set time.duration=" + std::to_string(scene->child("time")->number("duration") / 10);
  }
};

TEST_P(EveryPreset, is_valid_by_the_schema_that_stands_beside_it) {
  if (place.shell("command -v xmllint").code != 0) GTEST_SKIP() << "xmllint is not installed";
  const Outcome outcome = place.shell("xmllint --noout --schema '" + (root / "presets/scene.xsd").string() +
                                      "' '" + path.string() + "'");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

TEST_P(EveryPreset, is_called_as_its_file) {
  const auto scene = load_scene(path);
  const std::string name = scene->text("name"), stem = path.stem();
  EXPECT_TRUE(name == stem || name == path.parent_path().filename().string() + "-" + stem) << name;
}

// With the SIMD width that the program chooses, and two others (if the processor has them: simd_width.h) with
// another number of threads. The second run also makes the C library use its functions for old processors.
TEST_P(EveryPreset, runs_and_gives_the_same_state_again_on_any_vector_unit_and_on_two_threads) {
  const std::string part = std::getenv("REND_WHOLE") ? "" : tenth();
  const std::string old = "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX512F,-AVX2,-AVX,-FMA,-FMA4 REND_SIMD=sse2";
  const auto once = run(part + " --threads 1"), again = run(part + " --threads 1", old),
             two = run(part + " --threads 2", has_width(SimdWidth::Avx2) ? "REND_SIMD=avx2" : "");
  EXPECT_TRUE(once["stopped"].is_null());
  EXPECT_GT(once["steps"], 0);
  for (const char* what : {"hash", "tears", "energy"}) {
    EXPECT_EQ(once[what], again[what]) << what;
    EXPECT_EQ(once[what], two[what]) << what;
  }
}

// In the README, in presets/demo, or in a test or benchmark.
TEST_P(EveryPreset, is_used_by_somebody) {
  std::string texts = content(root / "README.md") + content(root / "presets/demo");
  for (const auto& entry : fs::recursive_directory_iterator(root / "tests"))
    if (entry.is_regular_file() && entry.path().filename() != "presets_test.cpp")
      texts += content(entry.path());
  std::string name = GetParam();
  // as tests/bench/table-7.1 composes its nine names
  for (const std::string cells : {"quads", "triangles", "mixed"})
    if (name.starts_with("tear/table-7.1-" + cells + "-"))
      name = "$cells" + name.substr(("tear/table-7.1-" + cells).size());
  EXPECT_NE(texts.find(name), std::string::npos) << "nobody names " << name;
}

// Those that presets/demo renders when it is not told which, and the showcase.
std::vector<std::string> shown_presets() {
  const std::string script = content(root / "presets/demo");
  const std::size_t begin = script.find("  showcase/bowl", script.find("|| clips=("));
  std::istringstream list(script.substr(begin, script.find(')', begin) - begin));
  std::set<std::string> names{std::istream_iterator<std::string>(list), {}};
  for (const std::string& name : all_presets())
    if (name.starts_with("showcase/")) names.insert(name);
  return {names.begin(), names.end()};
}

class ShownPreset : public EveryPreset {};

// The first two frames; with REND_WHOLE in the environment all of them.
TEST_P(ShownPreset, is_rendered_without_a_note) {
  NEEDS_PNG;
  const std::string frames = std::getenv("REND_WHOLE") ? "" : " --frames 0,1";
  const Outcome outcome =
      place.rend("render '" + path.string() + "' -o out --size 64x36 --set image.samples=1" + frames);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, testing::Not(testing::HasSubstr("note:")));
}

class PresetWithALaw : public EveryPreset {};

// (tests/sim/fracture/torn_presets_test.cpp tests that it tears.)
TEST_P(PresetWithALaw, goes_through_to_its_end) {
  if (!std::getenv("REND_WHOLE")) GTEST_SKIP() << "with REND_WHOLE in the environment";
  const auto figures = run("");
  EXPECT_TRUE(figures["stopped"].is_null());
  EXPECT_GT(figures["tears"], 0);
}

std::string as_word(const testing::TestParamInfo<std::string>& preset) {
  std::string name = preset.param;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name;
}
INSTANTIATE_TEST_SUITE_P(House, EveryPreset, testing::ValuesIn(all_presets()), as_word);
INSTANTIATE_TEST_SUITE_P(House, ShownPreset, testing::ValuesIn(shown_presets()), as_word);
INSTANTIATE_TEST_SUITE_P(House, PresetWithALaw, testing::ValuesIn(presets_with_laws()), as_word);

TEST(Presets, are_some) {
  EXPECT_GE(all_presets().size(), 14u);
  EXPECT_GE(presets_with_laws().size(), 8u);
  EXPECT_GE(shown_presets().size(), 22u);
}

TEST(Schema, beside_the_presets_is_what_the_program_prints) {
  const TestFolder place;
  const Outcome printed = place.rend("help schema");
  EXPECT_EQ(printed.code, 0);
  EXPECT_EQ(printed.out, content(root / "presets/scene.xsd")) << "rend help schema > presets/scene.xsd";
}

// Frame 0, one in fast motion, and the last.
TEST(Pictures, of_the_torn_cloth_are_the_same_bytes_twice_and_show_something) {
  NEEDS_PNG;
  const TestFolder place;
  const std::string render =
      "render '" + (root / "presets/tear/cloth-global-border.xml").string() + "' --size 160x90 --quiet";
  for (const char* frame : {"0", "15", "119"}) {
    for (const char* folder : {"one", "two"}) {
      const Outcome outcome = place.rend(render + " --frames " + frame + " -o " + folder);
      ASSERT_EQ(outcome.code, 0) << outcome.err;
    }
  }
  const std::string listed = place.shell("cd one && ls").out;
  EXPECT_EQ(listed, "00000.png\n00015.png\n00119.png\n");
  std::set<std::string> pictures;
  for (const char* name : {"00000.png", "00015.png", "00119.png"}) {
    const std::string one = content(place.path() / "one" / name);
    EXPECT_EQ(one, content(place.path() / "two" / name)) << name;
    EXPECT_GT(one.size(), 2000u) << name; // one colour would compress to a few hundred bytes
    pictures.insert(one);
  }
  EXPECT_EQ(pictures.size(), 3u);
}

} // namespace
} // namespace rend::presets_test
