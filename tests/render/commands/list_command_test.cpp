// rend list, and the times of presets that it states: presets/times.csv, as presets/measure writes it.
#include "render/facts/preset_list.h"
#include "tests/render/commands/program_run.h"
#include "tests/test_paths.h"

#include <gmock/gmock.h>

#include <cmath>

namespace rend::list_command_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using program::TestFolder;
using testing::HasSubstr;
const fs::path presets = fs::path(test::source_root) / "presets";

TEST(ListCommand, takes_the_first_sentence_of_the_first_comment) {
  EXPECT_EQ(first_sentence("<!--\n  The cloth of fig. 7.17: 10 x 10\n  quads. It tears. -->"),
            "The cloth of fig. 7.17: 10 x 10 quads");
  EXPECT_EQ(first_sentence("<!-- Falls -->"), "Falls");
  EXPECT_EQ(first_sentence("<scene/>"), "");
}

TEST(ListCommand, knows_every_preset_with_a_line_about_it_and_its_time) {
  for (const ListedPreset& one : list_presets(presets)) {
    EXPECT_FALSE(one.about.empty()) << one.file << " begins with no comment";
    EXPECT_TRUE(one.seconds && *one.seconds > 0)
        << one.file << " is not in presets/times.csv: run presets/measure";
  }
}

// A preset whose number of steps has changed takes another time: a sample, for each costs a set-up.
TEST(ListCommand, states_times_of_presets_as_they_are_now) {
  TestFolder place;
  const std::vector<ListedPreset> all = list_presets(presets);
  ASSERT_GT(all.size(), 80u);
  for (std::size_t n = 0; n < all.size(); n += 9) {
    const json info = place.rend("info '" + (presets / all[n].file).string() + "' --json").json();
    EXPECT_EQ(info["time"]["steps"], all[n].steps.value_or(-1)) << all[n].file << ": run presets/measure";
  }
}

// Within what other processors differ by: ten times.
TEST(ListCommand, states_a_time_that_a_run_takes) {
  TestFolder place;
  for (const ListedPreset& one : list_presets(presets)) {
    if (one.file != "tear/cloth-global-border.xml" && one.file != "cloth/mixed.xml") continue;
    const json figures = place.rend("run '" + (presets / one.file).string() + "' --threads 1 --json -q").json();
    const double seconds = figures["seconds"]["total"];
    EXPECT_LT(std::abs(std::log10(seconds / one.seconds.value_or(0))), 1)
        << one.file << " took " << seconds << " s";
  }
}

TEST(ListCommand, lists_figures_of_the_thesis_in_their_order) {
  TestFolder place;
  const std::string folder = "list '" + presets.string() + "' ";
  const json all = place.rend(folder + "--json").json(),
             figures = place.rend(folder + "--thesis --json").json();
  EXPECT_LT(figures.size(), all.size());
  std::vector<std::string> names;
  for (const json& one : figures) names.push_back(one["thesis"]);
  const auto at = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) - names.begin();
  };
  EXPECT_LT(at("6.38a"), at("6.40"));
  EXPECT_LT(at("6.40"), at("7.17"));
  EXPECT_THAT(place.rend(folder + "--thesis").out, HasSubstr("tear/cloth-global-border.xml"));
  EXPECT_EQ(place.rend("list nowhere").code, 66);
}

} // namespace
} // namespace rend::list_command_test
