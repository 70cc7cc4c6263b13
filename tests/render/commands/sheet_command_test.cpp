// rend sheet, against the pictures of rend render.
#include "render/draw/hud.h"
#include "render/files/png.h"
#include "tests/render/commands/program_run.h"
#include "tests/render/needs.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace rend::sheet_command_test {
namespace {

using program::Outcome;
using program::TestFolder;

Image part(const Image& sheet, int column, int row, int width, int height) {
  Image out(width, height);
  for (int y = 0; y < height; ++y)
    std::copy_n(sheet.at(column * (width + 6), row * (height + 6) + y), out.stride(), out.row(y));
  return out;
}

TEST(Sheet, shows_the_start_the_tear_and_the_end_as_render_draws_them) {
  NEEDS_PNG;
  const TestFolder place;
  place.write("pulled.xml", program::pulled);
  const Outcome made = place.rend("sheet pulled.xml pulled.xml -o sheet.png --size 96x54 -q");
  ASSERT_EQ(made.code, 0) << made.err;
  ASSERT_EQ(place.rend("render pulled.xml -o all --size 96x54 -q").code, 0);
  const Outcome run = place.rend("run pulled.xml --diagnostics d.csv --events e.jsonl -q");
  ASSERT_EQ(run.code, 0) << run.err;

  std::vector<Image> frames;
  for (int n = 0;; ++n) {
    const std::string name = fmt::format("all/{:05d}.png", n);
    if (!std::filesystem::exists(place.path() / name)) break;
    frames.push_back(read_png(place.path() / name));
  }
  const std::string events = program::content(place.path() / "e.jsonl");
  ASSERT_FALSE(events.empty());
  const double torn = nlohmann::json::parse(events.substr(0, events.find('\n'))).at("time");
  const Image sheet = read_png(place.path() / "sheet.png");
  ASSERT_EQ(sheet.width, 3 * 96 + 2 * 6);
  ASSERT_EQ(sheet.height, 2 * 54 + 6);
  for (int row = 0; row < 2; ++row) {
    EXPECT_EQ(part(sheet, 0, row, 96, 54), frames.front());
    EXPECT_EQ(part(sheet, 2, row, 96, 54), frames.back());
    const auto at = std::find(frames.begin(), frames.end(), part(sheet, 1, row, 96, 54));
    ASSERT_NE(at, frames.end());
    EXPECT_GE(static_cast<double>(at - frames.begin()) / 30, torn - 1.0 / 30);
  }
}

TEST(Sheet, sets_attributes_of_all_presets) {
  NEEDS_PNG;
  const TestFolder place;
  place.write("pulled.xml", program::pulled);
  const std::string line = "sheet pulled.xml --size 96x54 -q ";
  ASSERT_EQ(place.rend(line + "-o a.png").code, 0);
  ASSERT_EQ(place.rend(line + "-o b.png --set body.tear.threshold=1e9 --set time.duration=0.1").code, 0);
  EXPECT_NE(read_png(place.path() / "a.png"), read_png(place.path() / "b.png"));
  EXPECT_EQ(place.rend(line + "-o c.png --set body.tear.thresold=1").code, 64);
}

// Each row is that of the preset with this value alone, but for the label on its first picture, and the middle
// one, which is at one time in all rows: here when the row that tears has just torn.
TEST(Sheet, makes_a_row_of_each_value_of_a_sweep_and_says_which) {
  NEEDS_PNG;
  const TestFolder place;
  place.write("pulled.xml", program::pulled);
  const std::string line = "sheet pulled.xml --size 160x90 -o ", sweep = "body.tear.threshold=2,1e9";
  const Outcome made = place.rend(line + "both.png --sweep " + sweep);
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, testing::HasSubstr("row 2: pulled.xml body.tear.threshold=1e9 N: 0 tears, at 0, "));
  const auto tears = place.rend("run pulled.xml --json -q").json()["tears"].get<int>();
  EXPECT_THAT(made.out, testing::HasSubstr(fmt::format("threshold=2 N: {} tears, at 0, ", tears)));
  ASSERT_EQ(place.rend(line + "same.png -q --set " + sweep).code, 0);
  EXPECT_EQ(read_png(place.path() / "same.png"), read_png(place.path() / "both.png"));
  const Image both = read_png(place.path() / "both.png");
  ASSERT_EQ(both.height, 2 * 90 + 6);
  for (const int row : {0, 1}) {
    const std::string one = row == 0 ? "2" : "1e9";
    ASSERT_EQ(place.rend(line + "one.png -q --set body.tear.threshold=" + one).code, 0);
    const Image alone = read_png(place.path() / "one.png");
    EXPECT_EQ(part(both, 2, row, 160, 90), part(alone, 2, 0, 160, 90)) << row;
    EXPECT_EQ(part(both, 1, row, 160, 90) == part(alone, 1, 0, 160, 90), row == 0);
    EXPECT_EQ(part(both, 0, row, 160, 90) == part(alone, 0, 0, 160, 90), !hud_available());
  }
  EXPECT_EQ(place.rend(line + "bad.png -q --sweep body.tear.threshold=1,x").code, 65);
  EXPECT_FALSE(std::filesystem::exists(place.path() / "bad.png"));
}

// The middle pictures of a sweep are the frames of one number, of rend render.
TEST(Sheet, shows_all_rows_of_a_sweep_at_one_time_in_the_middle) {
  NEEDS_PNG;
  const TestFolder place;
  place.write("pulled.xml", program::pulled);
  const std::string sweep = "--sweep body.tear.threshold=1e9,2,4";
  const Outcome made = place.rend("sheet pulled.xml --size 96x54 -o sheet.png " + sweep);
  ASSERT_EQ(made.code, 0) << made.err;
  const Image sheet = read_png(place.path() / "sheet.png");
  const auto at = [&](std::size_t line) { // "..., at 0, T and 0.3 s"
    std::istringstream lines(made.out);
    std::string text;
    for (std::size_t n = 0; n <= line; ++n) std::getline(lines, text);
    return text.substr(text.find(", at 0, ") + 8);
  };
  EXPECT_EQ(at(1), at(2));
  EXPECT_EQ(at(2), at(3));
  const auto frame = std::lround(20 * std::stod(at(1)));
  ASSERT_GT(frame, 0);
  int row = 0;
  for (const char* value : {"1e9", "2", "4"}) {
    const std::string folder = std::string("all") + value;
    ASSERT_EQ(
        place.rend("render pulled.xml --size 96x54 -q -o " + folder + " --set body.tear.threshold=" + value)
            .code,
        0);
    EXPECT_EQ(part(sheet, 1, row++, 96, 54), read_png(place.path() / folder / fmt::format("{:05d}.png", frame)))
        << value;
  }
}

TEST(Sheet, shows_the_ends_alone_side_by_side) {
  NEEDS_PNG;
  const TestFolder place;
  place.write("pulled.xml", program::pulled);
  const std::string three = "pulled.xml pulled.xml pulled.xml -o ";
  ASSERT_EQ(place.rend("sheet " + three + "rows.png --size 96x54 -q").code, 0);
  const Outcome made = place.rend("sheet " + three + "ends.png --size 96x54 --ends 2");
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, testing::HasSubstr("2 rows of 2 pictures"));
  const Image rows = read_png(place.path() / "rows.png"), ends = read_png(place.path() / "ends.png");
  ASSERT_EQ(ends.width, 2 * 96 + 6);
  ASSERT_EQ(ends.height, 2 * 54 + 6);
  const Image end = part(rows, 2, 0, 96, 54);
  for (const auto& [column, row] : {std::pair(0, 0), std::pair(1, 0), std::pair(0, 1)})
    EXPECT_EQ(part(ends, column, row, 96, 54), end);
  const Image none = part(ends, 1, 1, 96, 54);
  EXPECT_TRUE(
      std::all_of(none.pixels.begin(), none.pixels.end(), [](std::uint8_t byte) { return byte == 255; }));
}

TEST(Sheet, leaves_nothing_where_a_preset_is_bad) {
  NEEDS_PNG;
  const TestFolder place;
  place.write("pulled.xml", program::pulled);
  const Outcome made = place.rend("sheet pulled.xml missing.xml -o sheet.png --size 96x54");
  EXPECT_EQ(made.code, 66);
  EXPECT_FALSE(std::filesystem::exists(place.path() / "sheet.png"));
}

} // namespace
} // namespace rend::sheet_command_test
