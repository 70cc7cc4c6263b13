#include "sim/study/study.h"

#include "sim/base/check.h"
#include "sim/base/enum_words.h"
#include "sim/study/duration.h"
#include "sim/study/reference.h"
#include "sim/study/runs.h"
#include "sim/study/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

constexpr double hopeless = 1;             // relative to the motion: such an error counts as a failure
constexpr double slow = 1, very_slow = 10; // [s] per run: slower ones are timed fewer times
constexpr int slow_reruns = 3;

// One study in progress.
class Maker {
public:
  Maker(const StudyPlan& plan, const MakeScene& make, const StudyCalls& calls)
      : plan_(plan), make_(make), calls_(calls) {}

  StudyReport run() {
    choose_stretch();
    report_.groups = plan_.groups;
    report_.samples = static_cast<int>(study_samples);
    report_.targets = {1e-1, 1e-2, 1e-3, 1e-4};
    for (std::size_t g = 0; g < plan_.groups.size(); ++g) run_group(g);
    conclude(report_);
    return std::move(report_);
  }

private:
  void choose_stretch() {
    const StudyDuration stretch = plan_.duration > 0
                                      ? StudyDuration{plan_.duration, "as asked for"}
                                      : study_duration(make_, plan_.groups.front().settings, calls_);
    report_.duration = stretch.seconds;
    report_.why_duration = stretch.why;
    Variant own;
    own.settings = plan_.groups.front().settings;
    const auto scene = make_(own);
    report_.clip = scene->duration();
    report_.tears = tears(*scene);
    report_.isolated = isolated(*scene);
    if (!(report_.duration > 0))
      throw UserError(Exit::BadInput, {}, "the clip has a duration of 0 s: there is nothing to study",
                      "Give the preset a duration, or say one by --duration.");
  }

  void say(const std::string& what) const {
    if (!calls_.progress) return;
    const double share = total_ > 0 ? static_cast<double>(done_) / static_cast<double>(total_) : 0;
    calls_.progress(what, share);
  }

  void run_group(std::size_t group) {
    const StudyGroup& here = plan_.groups[group];
    Reference reference = make_reference(make_, here, report_.duration, plan_.steps, calls_);
    if (group == 0) first_ = reference.trajectory;
    if (group > 0)
      if (const auto apart = compare(reference.trajectory, first_))
        reference.figures.distance = apart->position.over_time / report_.references.front().scales.length;
    report_.references.push_back(reference.figures);
    std::vector<std::pair<const Scheme*, Knob>> all;
    for (const std::string& name : plan_.integrators) {
      const Scheme* scheme = find_scheme(name);
      CHECK(scheme);
      const auto probe = make_({"", 0, {}, here.settings});
      for (const Knob& knob : sweep_of(*scheme, *probe, {report_.duration, plan_.steps, plan_.above_limit}))
        all.emplace_back(scheme, knob);
    }
    total_ = all.size() * plan_.groups.size();
    for (const auto& [scheme, knob] : all) {
      report_.rows.push_back(run_row(group, *scheme, knob, reference));
      ++done_;
    }
  }

  StudyRow run_row(std::size_t group, const Scheme& scheme, const Knob& knob, const Reference& reference) {
    Variant variant{scheme.name, report_.duration / static_cast<double>(knob.steps), knob.tolerance,
                    plan_.groups[group].settings};
    StudyRow row;
    row.group = group;
    row.integrator = scheme.name;
    row.step = variant.step;
    row.steps = knob.steps;
    row.tolerance = knob.tolerance;
    say(fmt::format(
        "{}{}, {}", plan_.groups[group].name.empty() ? "" : plan_.groups[group].name + ": ", scheme.name,
        knob.tolerance ? fmt::format("tolerance {:g}", *knob.tolerance) : fmt::format("{} steps", knob.steps)));
    std::shared_ptr<Scene> scene;
    try {
      scene = make_(variant);
    } catch (const UserError& error) {
      row.outcome = Outcome::Refused;
      row.reason = error.what();
      return row;
    }
    row.limit = scene->stability_limit(scheme);
    SampledRun run = sampled_run(*scene, knob.steps, calls_.going);
    take(run, reference, row);
    if (row.failed())
      row.time = summary_of({run.seconds});
    else
      row.time = timed(variant, knob.steps, run.seconds);
    return row;
  }

  void take(const SampledRun& run, const Reference& reference, StudyRow& row) const {
    row.outcome = run.outcome;
    row.reason = run.reason;
    row.steps_done = run.steps_done;
    row.counts = run.counts;
    row.tears = run.trajectory.tear_count;
    row.first_tear = run.trajectory.first_tear;
    row.torn_overlap = overlap(run.trajectory.torn, reference.trajectory.torn);
    row.answers = run.trajectory.answers;
    if (row.failed()) return;
    const double until = reference.trajectory.first_tear.value_or(std::numeric_limits<double>::infinity());
    row.errors = compare(run.trajectory, reference.trajectory, until);
    if (!row.errors) {
      row.outcome = Outcome::Unstable;
      row.reason = "it has no sample before the first tear of the reference";
      return;
    }
    const Scales& scales = reference.figures.scales;
    row.error = row.errors->position.over_time / scales.length;
    row.velocity_error = row.errors->velocity.over_time / scales.speed;
    row.energy_error = row.errors->energy / scales.energy;
    if (plan_.groups.size() > 1)
      if (const auto total = compare(run.trajectory, first_, until))
        row.total_error = total->position.over_time / report_.references.front().scales.length;
    if (row.error <= hopeless) return;
    row.outcome = Outcome::Inaccurate;
    row.reason = fmt::format("its error is {:.2g} times the motion", row.error);
  }

  RunTime timed(const Variant& variant, long steps, double first) const {
    const int count = first > very_slow ? 1 : first > slow ? std::min(slow_reruns, plan_.reruns) : plan_.reruns;
    std::vector<double> seconds;
    for (int n = 0; n < count; ++n) {
      const auto scene = make_(variant);
      seconds.push_back(timed_run(*scene, steps, calls_.going));
    }
    return summary_of(seconds);
  }

  const StudyPlan& plan_;
  const MakeScene& make_;
  const StudyCalls& calls_;
  StudyReport report_;
  Trajectory first_; // the first group's reference
  std::size_t done_ = 0, total_ = 0;
};

} // namespace

const char* name_of(Outcome outcome) {
  static constexpr EnumWords<Outcome::Refused> words{"done", "unstable", "unsolved", "astray", "refused"};
  return words[outcome];
}

double StudyRow::mean_step() const {
  const long parts = counts.substeps > 0 ? counts.substeps : steps;
  return step * static_cast<double>(steps) / static_cast<double>(parts);
}

StudyReport run_study(const StudyPlan& plan, const MakeScene& make, const StudyCalls& calls) {
  CHECK(!plan.groups.empty() && !plan.integrators.empty());
  return Maker(plan, make, calls).run();
}

} // namespace rend
