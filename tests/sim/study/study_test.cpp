// Whole studies of small scenes, against closed forms and against separate runs.
#include "sim/study/study.h"
#include "sim/study/sweep.h"
#include "tests/sim/presets.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

namespace rend::study_test {
namespace {

// Scenes from a format string with {0} (integrator), {1} (step) and {2} (tolerance, or empty).
MakeScene maker(const std::string& xml) {
  return [xml](const Variant& v) -> std::shared_ptr<Scene> {
    const std::string text = fmt::format(fmt::runtime(xml), v.integrator.empty() ? "symplectic" : v.integrator,
                                         v.step > 0 ? fmt::format("{:.17g}", v.step) : "auto",
                                         v.tolerance ? fmt::format("tolerance=\"{:.17g}\"", *v.tolerance) : "");
    auto loaded = std::make_shared<presets::Loaded>(presets::load(text));
    return {loaded->scene.get(), [loaded](const Scene*) {}};
  };
}

// A mass on a spring with w = 10/s, released from rest under gravity: z = (g/w²)(cos wt − 1).
const std::string oscillator = R"(<scene><body><sheet cells="1 1" size="1 1"/><place rotate="90 0 0"/>
  <mass total="0.4"/><springs><stretch k="10"/></springs><fix side="+z"/><probe name="mass" side="-z"/>
  <answer probe="mass" quantity="dz" at="1" value="-0.180512906" tolerance="1"/></body>
  <time integrator="{0}" step="{1}" {2} duration="3"/></scene>)";

StudyReport study(const std::string& xml, const std::vector<std::string>& integrators, double duration,
                  int steps) {
  StudyPlan plan;
  plan.integrators = integrators;
  plan.groups = {{}};
  plan.duration = duration;
  plan.steps = steps;
  plan.reruns = 2;
  return run_study(plan, maker(xml), {});
}

const StudyCurve& curve(const StudyReport& report, const std::string& name) {
  for (const StudyCurve& c : report.curves)
    if (c.integrator == name) return c;
  throw std::logic_error(name);
}

TEST(Study, of_an_oscillator_has_the_errors_of_the_closed_form) {
  const StudyReport report = study(oscillator, {"symplectic"}, 1, 5);
  const double g = 9.81, w = 10;
  for (const StudyRow& row : report.rows) {
    if (row.failed() || row.steps < 16) continue;
    // z_n = (g/w²)(cos((n + 1/2) θ)/cos(θ/2) − 1), sin(θ/2) = w h/2. Two of the four masses move.
    const double theta = 2 * std::asin(w * row.step / 2);
    double square = 0;
    for (long k = 1; k <= 16; ++k) {
      const double n = static_cast<double>(k * row.steps / 16);
      const double z = std::cos((n + 0.5) * theta) / std::cos(theta / 2) - std::cos(w * n * row.step);
      square += std::pow(z * g / (w * w), 2) / 16;
    }
    EXPECT_NEAR(row.errors->position.over_time, std::sqrt(square / 2), 1e-9 + 1e-7 * std::sqrt(square))
        << row.steps;
    ASSERT_EQ(row.answers.size(), 1u);
    const double n = static_cast<double>(row.steps);
    const double z = g / (w * w) * (std::cos((n + 0.5) * theta) / std::cos(theta / 2) - 1);
    EXPECT_NEAR(row.answers[0].error, std::abs(z + 0.180512906) / 0.180512906, 1e-8);
  }
}

TEST(Study, sees_the_orders_of_all_schemes_and_trusts_its_reference) {
  const StudyReport report = study(
      oscillator, {"symplectic", "verlet", "midpoint", "rk4", "rk45", "implicit", "tr-bdf2", "alpha"}, 0.4, 8);
  for (const char* name : {"symplectic", "verlet", "midpoint", "rk4", "tr-bdf2", "alpha"}) {
    const StudyCurve& c = curve(report, name);
    ASSERT_TRUE(c.fit) << name;
    EXPECT_NEAR(c.fit->order, c.theory, 0.1) << name;
  }
  EXPECT_NEAR(curve(report, "implicit").fit->order, 1, 0.1);
  const StudyReference& r = report.references[0];
  EXPECT_LT(r.bar, 1e-12);
  for (const StudyRow& row : report.rows)
    EXPECT_TRUE(row.failed() || row.doubtful == (row.error <= 10 * r.bar));
}

TEST(Study, keeps_failed_runs_as_rows_and_explicit_euler_without_any_stable_step) {
  const StudyReport report = study(oscillator, {"symplectic", "explicit"}, 3, 4);
  std::size_t failed = 0;
  for (const StudyRow& row : report.rows) {
    if (row.integrator == "explicit") {
      EXPECT_EQ(row.limit, 0);
      EXPECT_TRUE(row.above_limit());
    }
    if (!row.failed()) continue;
    ++failed;
    EXPECT_TRUE(row.above_limit());
    EXPECT_FALSE(row.reason.empty());
    EXPECT_FALSE(row.on_front);
  }
  EXPECT_GE(failed, 2u);
}

TEST(Study, marks_what_is_not_above_its_error_bar) {
  StudyReport report;
  report.groups = {{}};
  report.references.resize(1);
  report.references[0].bar = 1e-6;
  for (double error : {1e-2, 1e-3, 2e-5, 9e-6}) {
    StudyRow row;
    row.integrator = "verlet";
    row.step = std::sqrt(error);
    row.steps = 1;
    row.error = error;
    row.time.median = 1 / error;
    report.rows.push_back(row);
  }
  conclude(report);
  EXPECT_FALSE(report.references[0].good_enough());
  EXPECT_EQ(report.references[0].smallest, 9e-6);
  EXPECT_FALSE(report.rows[2].doubtful);
  EXPECT_TRUE(report.rows[3].doubtful);
  EXPECT_NEAR(report.curves[0].fit->order, 2, 1e-12);
  EXPECT_EQ(report.curves[0].fit->used.size(), 3u);
  report.references[0].bar = 9e-7;
  conclude(report);
  EXPECT_TRUE(report.references[0].good_enough());
}

TEST(Study, of_what_tears_compares_up_to_the_first_tear) {
  const std::string cloth = presets::cloth("quads", 4, R"(<tear criterion="global-border" threshold="0.06"/>)",
                                           R"(<time integrator="{0}" step="{1}" {2} duration="1"/>)");
  const StudyReport report = study(cloth, {"symplectic", "verlet"}, 0, 4);
  ASSERT_TRUE(report.tears);
  ASSERT_TRUE(report.references[0].first_tear);
  EXPECT_GT(report.duration, *report.references[0].first_tear);
  EXPECT_LT(report.duration, 1);
  const StudyRow& finest = report.rows.back();
  EXPECT_NEAR(*finest.first_tear, *report.references[0].first_tear, 3 * finest.step);
  EXPECT_GT(finest.torn_overlap, 0.5);
  EXPECT_LT(finest.errors->samples, 16u);
  EXPECT_LT(finest.error, 1e-3);
}

TEST(Study, of_what_flies_freely_keeps_its_momentum) {
  const StudyReport report = study(R"(<scene><body><sheet cells="2 2" size="1 1"/><mass total="1"/>
    <springs young="1e3" poisson="0.3" thickness="0.01"><stretch/></springs></body><world gravity="0 0 0"/>
    <time integrator="{0}" step="{1}" {2} duration="1"/></scene>)",
                                   {"symplectic"}, 0.1, 3);
  EXPECT_TRUE(report.isolated);
  for (const StudyRow& row : report.rows) EXPECT_TRUE(row.failed() || row.errors->momentum.value() < 1e-12);
  EXPECT_FALSE(study(oscillator, {"symplectic"}, 0.1, 3).isolated);
}

TEST(Sweep, covers_two_decades_of_steps_that_meet_all_samples) {
  const auto scene = maker(oscillator)({});
  for (int count : {3, 6, 8, 13}) {
    const auto knobs = sweep_of(*find_scheme("verlet"), *scene, {3, count, false});
    ASSERT_EQ(knobs.size(), static_cast<std::size_t>(count));
    EXPECT_GE(static_cast<double>(knobs.back().steps), 100.0 * static_cast<double>(knobs.front().steps));
    EXPECT_LE(3.0 / static_cast<double>(knobs.front().steps), scene->stability_limit(*find_scheme("verlet")));
    for (const Knob& knob : knobs) EXPECT_EQ(knob.steps % study_samples, 0);
  }
  const auto above = sweep_of(*find_scheme("verlet"), *scene, {12.8, 8, true});
  EXPECT_GT(12.8 / static_cast<double>(above.front().steps),
            1.5 * scene->stability_limit(*find_scheme("verlet")));
  const auto implicit = sweep_of(*find_scheme("implicit"), *scene, {3, 6, false});
  EXPECT_EQ(implicit.front().steps, 4);
  const auto adaptive = sweep_of(*find_scheme("rk45"), *scene, {3, 8, false});
  EXPECT_NEAR(*adaptive.front().tolerance, 1e-2, 1e-15);
  EXPECT_NEAR(*adaptive.back().tolerance, 1e-9, 1e-22);
}

} // namespace
} // namespace rend::study_test
