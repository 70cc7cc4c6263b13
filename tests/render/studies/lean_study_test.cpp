// rend study --lean: features have no effect where they must have none, and features that are off take no
// bytes. Times are not tested here.
#include "render/picture/scene_preset.h"
#include "render/studies/lean_study.h"
#include "sim/build/build_scene.h"
#include "sim/study/minimal_loop.h"
#include "tests/render/commands/program_run.h"

#include <gmock/gmock.h>

#include <map>

namespace rend::lean_study_test {
namespace {

using program::Outcome;
using program::TestFolder;
using testing::HasSubstr;

// A few steps of every feature on the built-in scenes, made small.
const std::vector<LeanRow>& rows() {
  static const std::vector<LeanRow> all = [] {
    LeanPlan plan;
    plan.scenes = lean_scenes();
    const auto shrink = [](std::string& text, const std::string& cells, const std::string& fewer) {
      text.replace(text.find(cells), cells.size(), fewer);
    };
    shrink(plan.scenes[0].text, "cells=\"48 48\"", "cells=\"12 12\"");
    shrink(plan.scenes[1].text, "cells=\"12 4 4\"", "cells=\"4 2 2\"");
    plan.builds = 2;
    plan.pairs = 2;
    plan.seconds = 1e-4;
    return run_lean(plan, {});
  }();
  return all;
}

TEST(LeanStudy, every_feature_keeps_what_it_promises) {
  for (const LeanRow& row : rows())
    EXPECT_TRUE(row.as_required()) << row.scene << ", " << row.feature << " " << row.same_state
                                   << row.same_pixels;
}

TEST(LeanStudy, every_feature_is_measured_somewhere) {
  std::map<std::string, bool> measured;
  for (const LeanRow& row : rows()) measured[row.feature] = measured[row.feature] || row.measured();
  EXPECT_EQ(measured.size(), lean_features().size());
  for (const auto& [feature, somewhere] : measured) EXPECT_TRUE(somewhere) << feature;
}

TEST(LeanStudy, what_is_not_asked_for_takes_no_bytes) {
  int scenes = 0;
  for (const LeanRow& row : rows()) {
    if (row.feature == "viscosity 0 per particle") {
      EXPECT_EQ(row.bytes_on, row.bytes_off);
    }
    if (row.feature != "all that is not asked for") continue;
    ++scenes;
    EXPECT_TRUE(row.measured()) << row.refused;
    EXPECT_EQ(row.bytes_on, 0u);
    EXPECT_TRUE(row.same_state);
  }
  EXPECT_EQ(scenes, 2);
}

TEST(MinimalLoop, goes_as_the_scene_does) {
  for (const char* integrator : {"symplectic", "verlet", "rk4"}) {
    const auto preset =
        load_scene_text(lean_scenes()[0].text, "p",
                        std::vector<Override>{{"body.sheet.cells", "8 8"}, {"time.integrator", integrator}});
    Scene scene(read_scene(*preset), {}), same(read_scene(*preset), {});
    MinimalLoop bare(same);
    for (int n = 0; n < 100; ++n) {
      scene.step();
      bare.step();
    }
    EXPECT_EQ(scene.hash(), same.hash()) << integrator;
  }
}

TEST(LeanStudy, of_a_preset_writes_its_tables_and_its_page) {
  const TestFolder place;
  place.write("pulled.xml", program::pulled);
  const Outcome outcome = place.rend("study --lean pulled.xml -q --quick -o lean --set body.sheet.cells='3 3'");
  EXPECT_EQ(outcome.code, 0) << outcome.err << outcome.out;
  EXPECT_THAT(outcome.out, testing::AllOf(HasSubstr("walking the map"), HasSubstr("Not there:")));
  EXPECT_EQ(place.files(), (std::vector<std::string>{"lean", "lean/index.html", "lean/lean.csv",
                                                     "lean/lean.json", "pulled.xml"}));
}

TEST(LeanStudy, is_asked_for_with_any_number_of_presets_and_a_study_with_one) {
  const TestFolder place;
  EXPECT_EQ(place.rend("study").code, 64);
  EXPECT_EQ(place.rend("study one.xml two.xml").code, 64);
  EXPECT_EQ(place.rend("study --lean missing.xml").code, 66);
}

} // namespace
} // namespace rend::lean_study_test
