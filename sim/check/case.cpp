#include "sim/check/case.h"
#include "sim/base/enum_words.h"
#include "sim/build/build_scene.h"

#include "sim/check/families.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <new>

namespace rend {

const char* name_of(Verdict verdict) {
  static constexpr EnumWords<Verdict::Failed> words{"ok", "refused", "known limit", "failed"};
  return words[verdict];
}

void Finding::within(std::string measure, double got, double low, double high) {
  measures.push_back({std::move(measure), got, low, high});
}
void Finding::at_most(std::string measure, double got, double high) {
  within(std::move(measure), got, -std::numeric_limits<double>::infinity(), high);
}
void Finding::at_least(std::string measure, double got, double low) {
  within(std::move(measure), got, low, std::numeric_limits<double>::infinity());
}
void Finding::near(std::string measure, double got, double known, double error) {
  within(std::move(measure), got, known - error, known + error);
}
void Finding::limit(std::string what_happens, std::string reason) {
  verdict = Verdict::Limit;
  what = std::move(what_happens);
  why = std::move(reason);
}
bool Finding::holds() const {
  return std::all_of(measures.begin(), measures.end(), [](const Measure& m) { return m.holds(); });
}

Trial Bench::open(const Sets& sets, SceneOptions options) const {
  Trial trial;
  trial.preset = (*read_)(*case_, nullptr, sets);
  trial.scene = std::make_unique<Scene>(read_scene(*trial.preset, *pictures_), options);
  return trial;
}

Trial Bench::open_text(const std::string& preset) const {
  Trial trial;
  trial.preset = (*read_)(*case_, &preset, {});
  trial.scene = std::make_unique<Scene>(read_scene(*trial.preset, *pictures_), SceneOptions{});
  return trial;
}

const std::vector<CheckFamily>& all_families() {
  static const std::vector<CheckFamily> list{
      stiffness_family(), mass_family(),       poisson_family(), step_limit_family(), long_family(),
      shape_family(),     degenerate_family(), speed_family(),   size_family(),       tear_family(),
      fault_family(),     energy_family(),     rest_family(),    contact_family(),    contact_at_rest_family()};
  return list;
}

CheckResult run_case(const CheckCase& which, const ReadPreset& read, const ScenePictures& pictures) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  CheckResult result;
  Finding& finding = result.finding;
  const auto fail = [&](const std::string& what, const std::string& why) {
    finding.verdict = Verdict::Failed;
    finding.what = what;
    finding.why = why;
  };
  try {
    which.run(Bench(which, read, pictures), finding);
    if (finding.verdict != Verdict::Failed && !finding.holds())
      fail(finding.what.empty() ? "a figure lies outside of its bounds" : finding.what, finding.why);
  } catch (const UserError& error) {
    fail(error.what(), error.hint);
  } catch (const std::bad_alloc&) { // also from libraries
    throw;
  } catch (const std::exception& error) { // a bug: the other cases still run
    fail(error.what(), "this is a fault of rend itself");
  }
  result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return result;
}

} // namespace rend
