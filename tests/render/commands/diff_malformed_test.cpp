// rend diff on malformed files: each affects only its own pair, and memory does not grow with the sizes that
// they claim.
#include "render/files/png.h"
#include "tests/render/commands/program_run.h"
#include "tests/render/needs.h"
#include "tests/render/peak_memory.h"
#include "tests/render/pictures.h"
#include "tests/render/png_files.h"

#include <gmock/gmock.h>

namespace rend::diff_malformed_test {
namespace {

using namespace test;
using program::content;
using program::Outcome;
using program::TestFolder;
using testing::HasSubstr;
namespace fs = std::filesystem;

class DiffLies : public testing::Test {
protected:
  void SetUp() override {
    NEEDS_PNG;
    for (const char* folder : {"a", "b"}) {
      fs::create_directories(place.path() / folder);
      for (const char* name : {"1-match.png", "9-match.png"})
        write_png(place.path() / folder / name, pattern(40, 30));
    }
    write_png(place.path() / "a/5-differ.png", pattern(40, 30));
    write_png(place.path() / "b/5-differ.png", pattern(40, 30, 3, 1));
  }
  // All other pairs are compared, the page is written, and memory stays small.
  void expect_one_trouble(const std::string& name, const std::string& why, const std::string& more = "") const {
    int code = -1;
    const std::int64_t peak = peak_of([&] {
      code = place.rend("diff a b -o report --json --threads 2" + more).code;
      place.write("code", std::to_string(code));
    });
    EXPECT_EQ(content(place.path() / "code"), "2");
    EXPECT_GT(peak, 0);
    EXPECT_LT(peak, 200 * megabyte);
    const nlohmann::json report = nlohmann::json::parse(content(place.path() / "report/diff.json"));
    std::map<std::string, std::string> states;
    for (const auto& one : report["cases"]) {
      states[one["name"]] = one["state"];
      if (one["name"] == name) {
        EXPECT_THAT(one["why"][0], HasSubstr(why));
      }
    }
    const std::map<std::string, std::string> expected{
        {"1-match.png", "match"}, {name, "unreadable"}, {"5-differ.png", "differ"}, {"9-match.png", "match"}};
    EXPECT_EQ(states, expected);
    EXPECT_THAT(content(place.path() / "report/index.html"), HasSubstr(name));
    fs::remove_all(place.path() / "report");
  }

  const TestFolder place;
};

TEST_F(DiffLies, four_bytes_of_another_format_end_nothing) {
  write_png(place.path() / "a/3.png", pattern(40, 30));
  for (const char* bytes : {"RIFF", "RIFF1", "RIFF1234", "RIFF1234WEB", "II*", "v/1", "\x89PNG"}) {
    place.write("b/3.png", bytes);
    expect_one_trouble("3.png", "this is not a PNG");
  }
  place.write("b/3.png", "RIFF1234WEBPVP8 ");
  expect_one_trouble("3.png", "this is a WebP");
}

TEST_F(DiffLies, a_picture_of_65_bytes_takes_no_gigabytes) {
  for (const bool interlaced : {false, true}) {
    const std::string file =
        png_file(header_of(16384, 16384, 16, 6, interlaced), png_chunk("IDAT", deflated("")));
    place.write("a/3.png", file);
    place.write("b/3.png", file);
    expect_one_trouble("3.png", "cannot hold them");
    fs::remove(place.path() / "a/3.png"); // not expected at all
    expect_one_trouble("3.png", "cannot hold them");
  }
}

// Valid pictures of 33 kB a file that would take 26 GB.
TEST_F(DiffLies, pictures_that_are_too_large_for_the_memory_are_told_so) {
  place.write("a/3.png", black_png(header_of(16384, 16384, 1, 0)));
  fs::copy_file(place.path() / "a/3.png", place.path() / "b/3.png");
  expect_one_trouble("3.png", "it has 16384 x 16384 pixels in");
  const Outcome alone = place.rend("diff a/3.png b/3.png");
  EXPECT_EQ(alone.code, 2);
  EXPECT_THAT(alone.out, HasSubstr("GB of memory, and "));
}

// It took 0.6 GB when it was decoded as a whole.
TEST_F(DiffLies, a_picture_that_is_compared_with_nothing_is_looked_through_row_by_row) {
  place.write("b/3.png", black_png(header_of(8192, 8192, 1, 0)));
  const std::int64_t peak = peak_of([&] {
    const nlohmann::json report = place.rend("diff a b --json").json();
    place.write("state", report["cases"][1]["state"].get<std::string>());
  });
  EXPECT_EQ(content(place.path() / "state"), "new");
  EXPECT_GT(peak, 0);
  EXPECT_LT(peak, 200 * megabyte);
}

TEST_F(DiffLies, a_file_that_is_mostly_a_hole_is_not_read) {
  place.write("a/3.png", black_png(header_of(20, 20)));
  fs::copy_file(place.path() / "a/3.png", place.path() / "b/3.png");
  fs::resize_file(place.path() / "b/3.png", std::uintmax_t{1} << 40);
  expect_one_trouble("3.png", "in 1099511627776 bytes");
  place.write("b/3.png", "no PNG");
  fs::resize_file(place.path() / "b/3.png", std::uintmax_t{1} << 40);
  expect_one_trouble("3.png", "this is not a PNG");
}

TEST_F(DiffLies, a_mask_of_one_picture_is_the_trouble_of_that_one) {
  for (const char* folder : {"a", "b"}) write_png(place.path() / folder / "3.png", pattern(40, 30));
  write_png(place.path() / "mask.png", pattern(30, 40));
  place.write("t.xml", R"(<tolerances><case name="3*" mask="mask.png"/></tolerances>)");
  expect_one_trouble("3.png", "the mask has 30 x 40 pixels", " -t t.xml");
}

} // namespace
} // namespace rend::diff_malformed_test
