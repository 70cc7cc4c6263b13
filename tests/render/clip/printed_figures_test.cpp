// Figures that another process printed: what this program writes is read back, and what it does not write is
// not taken for figures.
#include "render/clip/figures.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace rend::printed_figures_test {
namespace {

Figures figures() {
  Figures figures;
  figures.state.steps = 12;
  figures.state.time = 1.0 / 3;
  figures.state.tears = 4;
  figures.state.hash = 0xab;
  figures.pictures = PictureFigures{.made = 7, .kept = 2};
  return figures;
}

TEST(PrintedFigures, are_read_as_they_were_printed) {
  const auto read = read_figures(json_of(figures()).dump(2));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->pictures.made, 7);
  EXPECT_EQ(read->pictures.kept, 2);
  EXPECT_EQ(read->steps, 12);
  EXPECT_EQ(read->time, 1.0 / 3);
  EXPECT_EQ(read->tears, 4U);
  EXPECT_EQ(read->hash, "00000000000000ab");
}

TEST(PrintedFigures, of_a_run_that_simulated_nothing_know_its_pictures_alone) {
  Figures none = figures();
  none.simulated = false;
  const auto read = read_figures(json_of(none).dump());
  ASSERT_TRUE(read);
  EXPECT_EQ(read->pictures.kept, 2);
  EXPECT_FALSE(read->steps || read->time || read->tears || read->hash);
}

TEST(PrintedFigures, are_not_what_is_cut_off_or_something_else) {
  const std::string whole = json_of(figures()).dump();
  EXPECT_FALSE(read_figures(whole.substr(0, whole.size() - 1)));
  for (const char* text : {"", "null", "[]", "{}", "7", R"({"frames": "7", "kept": 2})"})
    EXPECT_FALSE(read_figures(text)) << text;
}

} // namespace
} // namespace rend::printed_figures_test
