#include "sim/check/case.h"

#include "render/pages/check_report.h"
#include "render/picture/scene_preset.h"
#include "render/studies/check_run.h"
#include "sim/check/families.h"
#include "sim/check/watch.h"

#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <random>
#include <set>

namespace rend::case_test {
namespace {

const ReadPreset read = [](const CheckCase& which, const std::string* instead, const Sets& sets) {
  std::vector<Override> overrides;
  for (const auto& [path, value] : sets) overrides.push_back({path, value});
  return load_scene_text(instead ? *instead : which.preset, which.name, overrides);
};

// Masses on springs with symplectic Euler: ω = 20/s, so the stable step is 0.1 s.
CheckCase oscillator(const std::string& step) {
  CheckCase one;
  one.name = "test/oscillator";
  one.expectation = "the energy stays below ten times its start";
  one.preset = fmt::format(R"(<scene name="o"><body name="b"><sheet cells="1 1" size="1 1"/><mass total="0.4"/>
    <springs><stretch k="20"/></springs><fix side="+y"/></body><world gravity="0 0 0"/>
    <time step="{}" integrator="symplectic" duration="100"/></scene>)",
                           step);
  one.run = [](const Bench& bench, Finding& finding) {
    const Trial trial = bench.open({}, unguarded());
    shake(trial.body(), 1e-6, 1);
    const Course course = run(*trial.scene, 300);
    finding.at_most("energy over its start", course.stopped ? NAN : course.most_energy / course.first_energy,
                    10);
  };
  return one;
}

TEST(CheckCase, IsOkWhereItsMeasuresHold) {
  EXPECT_EQ(run_case(oscillator("0.05"), read).finding.verdict, Verdict::Ok);
}

TEST(CheckCase, FailsWhereTheStepIsTooLarge) {
  const CheckResult result = run_case(oscillator("0.3"), read);
  EXPECT_EQ(result.finding.verdict, Verdict::Failed);
  EXPECT_FALSE(result.finding.holds());
  CheckChapter chapter{{"test", "Test", "", nullptr}, {oscillator("0.3")}, {result}};
  EXPECT_EQ(count({chapter}).failed, 1u);
  EXPECT_NE(check_page({chapter}, 1).find(">failed<"), std::string::npos);
}

TEST(CheckCase, FailsInWordsWhereSomethingIsThrown) {
  CheckCase one = oscillator("-1");
  const CheckResult result = run_case(one, read);
  EXPECT_EQ(result.finding.verdict, Verdict::Failed);
  EXPECT_NE(result.finding.what.find("step"), std::string::npos);
  one.run = [](const Bench&, Finding& finding) { finding.at_most("x", NAN, 1); };
  EXPECT_EQ(run_case(one, read).finding.verdict, Verdict::Failed); // NaN is within no bounds
}

TEST(CheckFamilies, HaveNamesOfTheirOwnAndGoodPresets) {
  std::set<std::string> names, files;
  for (const CheckFamily& family : all_families())
    for (const CheckCase& one : family.cases()) {
      EXPECT_TRUE(one.name.starts_with(family.name + "/")) << one.name;
      EXPECT_TRUE(names.insert(one.name).second) << one.name;
      EXPECT_TRUE(files.insert(file_name(one.name)).second) << one.name;
      EXPECT_FALSE(one.expectation.empty()) << one.name;
    }
  EXPECT_GT(names.size(), 500u);
}

TEST(CheckFamilies, HoldInTheirQuickCases) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("rend-cases-" + std::to_string(std::random_device()()));
  std::filesystem::create_directories(folder);
  for (const CheckFamily& family : all_families()) {
    std::vector<CheckCase> quick;
    for (CheckCase& one : family.cases())
      if (one.quick) quick.push_back(std::move(one));
    EXPECT_TRUE(quick.size() >= 3 || family.name == "long") << family.name; // a million steps are not quick
    write_cases(folder, quick);
    const auto look = [&](std::size_t n, const CheckResult& result) {
      EXPECT_NE(result.finding.verdict, Verdict::Failed) << quick[n].name << ": " << result.finding.what;
    };
    run_cases(folder, quick, 2, look, [] {});
  }
  std::filesystem::remove_all(folder);
}

} // namespace
} // namespace rend::case_test
