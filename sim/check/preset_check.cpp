#include "sim/check/preset_check.h"

#include "sim/check/step_limit.h"
#include "sim/check/watch.h"
#include "sim/topology/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

constexpr long most_steps = 100000, few_steps = 2000, probe_steps = 300;

CheckCase made(const std::string& name, const std::string& path, const std::string& what,
               const std::string& expectation, std::function<void(const Bench&, Finding&)> run) {
  CheckCase one;
  one.name = name + "/" + what;
  one.expectation = expectation;
  one.path = path;
  one.run = std::move(run);
  one.row = what;
  return one;
}

long steps_of(const Scene& scene, long most) {
  return std::min(most, std::max(1L, std::lround(scene.duration() / scene.step_size())));
}

void ask_for_soundness(const Trial& trial, const Course& course, Finding& finding) {
  finding.at_most("stopped as unstable", course.stopped, 0);
  finding.at_least("finite", is_finite(*trial.scene), 1);
  finding.at_most("energy without a cause, of all that there was", trial->energy().gained_share(),
                  most_gained_share);
  for (const auto& body : trial->bodies()) {
    const auto broken = validate(body->map->map());
    finding.at_most(broken ? "broken axioms of the map: " + broken->text() : "broken axioms of the map",
                    broken.has_value(), 0);
  }
}

void as_it_is(const Bench& bench, Finding& finding) {
  const Trial trial = bench.open();
  const Course course = run(*trial.scene, steps_of(*trial.scene, most_steps), 100);
  ask_for_soundness(trial, course, finding);
  finding.what =
      course.stopped
          ? course.why
          : fmt::format("{} steps of {:.3g} s with {}, {} tears, {} steps redone by the guard", course.steps,
                        trial->step_size(), trial->scheme().name, trial->tears(), trial->guard().rejected);
}

// With the automatic step of the scheme, or the preset's if it has none.
void with_scheme(const Scheme& scheme, const Bench& bench, Finding& finding) {
  const Sets sets{{"time.integrator", scheme.name}};
  Trial trial;
  try {
    Sets automatic = sets;
    if (!scheme.solves && !scheme.adaptive)
      automatic.emplace_back("time.step", "auto");
    else if (const Trial own = bench.open(); own->automatic_step()) // one per frame
      automatic.emplace_back("time.step", fmt::format("{}", std::max(own->duration() / 100, own->step_size())));
    trial = bench.open(automatic);
  } catch (const UserError& error) {
    if (error.code != Exit::BadInput) throw;
    finding.verdict = Verdict::Refused;
    finding.what = error.what();
    finding.why = error.hint;
    return;
  }
  const Course course = run(*trial.scene, steps_of(*trial.scene, few_steps), 100);
  if (scheme.name == "static" && course.stopped) { // there may be no equilibrium
    finding.verdict = Verdict::Refused;
    finding.what = course.why;
    finding.why = "an equilibrium takes a hold and forces that balance; implicit needs neither";
    return;
  }
  ask_for_soundness(trial, course, finding);
  finding.what = course.stopped ? course.why
                                : fmt::format("{} steps of {:.3g} s, {} redone", course.steps,
                                              trial->step_size(), trial->guard().rejected);
}

// Whether the guard redoes no step in the first part of the clip.
bool runs_by_itself(const Bench& bench, double step, double time) {
  const Trial trial = bench.open({{"time.step", fmt::format("{}", step)}});
  const Course course = run(*trial.scene, std::max(1L, std::lround(time / step)), 1000000);
  return !course.stopped && trial->guard().rejected == 0;
}

void margin(const Bench& bench, Finding& finding) {
  const Trial trial = bench.open();
  if (trial->scheme().solves || trial->scheme().adaptive) {
    finding.what =
        fmt::format("with '{}' every step is stable; its size is a matter of accuracy", trial->scheme().name);
    return;
  }
  StepLimit least;
  least.step = std::numeric_limits<double>::infinity();
  for (const auto& body : trial->bodies()) {
    Linearised linear(*body, 0);
    const StepLimit one = step_limit(trial->scheme(), linear);
    if (one.step < least.step) least = one;
  }
  const double used = trial->step_size(), time = std::min(trial->duration(), probe_steps * used);
  double low = used, high = used;
  if (runs_by_itself(bench, used, time)) {
    while (high < 256 * used && runs_by_itself(bench, high *= 2, time)) low = high;
  } else {
    while (low > used / 256 && !runs_by_itself(bench, low /= 2, time)) high = low;
  }
  while (high > 1.05 * low) {
    const double middle = std::sqrt(low * high);
    (runs_by_itself(bench, middle, time) ? low : high) = middle;
  }
  finding.at_least("step that breaks over the one used", high / used, 1);
  finding.what = fmt::format(
      "used {:.3g} s; at rest stable up to {:.3g} s (highest frequency {:.4g}/s); the first {:.3g} s run "
      "without the guard up to {:.3g} s",
      used, least.step, least.omega, time, low);
}

void with_fault(StepStage stage, const Bench& bench, Finding& finding) {
  SceneOptions options;
  options.fault = Fault{.stage = stage, .step = 20};
  const Trial trial = bench.open({}, options);
  const Course course = run(*trial.scene, steps_of(*trial.scene, probe_steps), 100);
  ask_for_soundness(trial, course, finding);
  finding.what = course.stopped ? course.why : fmt::format("{} steps redone", trial->guard().rejected);
}

void same_on_threads(const Bench& bench, Finding& finding) {
  SceneOptions two;
  two.threads = 2;
  const Trial one = bench.open(), other = bench.open({}, two);
  const long steps = steps_of(*one.scene, probe_steps);
  run(*one.scene, steps, steps);
  run(*other.scene, steps, steps);
  finding.at_least("same hash", one->hash() == other->hash(), 1);
  finding.what = fmt::format("{:016x} after {} steps", one->hash(), steps);
}

void tears_finite(const Bench& bench, Finding& finding) {
  const Trial trial = bench.open();
  const Course course = run(*trial.scene, steps_of(*trial.scene, few_steps), 1000);
  bool finite = true;
  for (const auto& body : trial->bodies())
    for (const TearEvent& event : body->events)
      finite = finite && std::isfinite(event.value) && event.place.allFinite();
  finding.at_least("values and places of tears are finite", finite, 1);
  finding.what = fmt::format("{} tears in {} steps", trial->tears(), course.steps);
}

} // namespace

std::vector<CheckCase> preset_cases(const std::string& name, const std::string& path) {
  std::vector<CheckCase> all;
  all.push_back(made(name, path, "as it is",
                     "runs to its end, or for 1e5 steps: not stopped, finite, a valid map", as_it_is));
  all.push_back(made(name, path, "margin",
                     "its step is below the one at which the first 300 steps' time needs the guard, or stops",
                     margin));
  for (const Scheme& scheme : all_schemes())
    all.push_back(
        made(name, path, "integrator " + scheme.name,
             "2000 steps of its automatic size (where it solves, of the preset's, or a hundredth of the clip), "
             "or refused with "
             "what would work",
             [&scheme](const Bench& bench, Finding& finding) { with_scheme(scheme, bench, finding); }));
  for (const StepStage stage :
       {StepStage::Forces, StepStage::Loads, StepStage::Integration, StepStage::Contact})
    all.push_back(made(name, path, fmt::format("fault in {}", name_of(stage)),
                       "a NaN in step 20 (put there by the check): redone, and nothing of it is left",
                       [stage](const Bench& bench, Finding& finding) { with_fault(stage, bench, finding); }));
  all.push_back(made(name, path, "threads", "one thread and two give the same bytes", same_on_threads));
  all.push_back(made(name, path, "tears", "every tear has a finite value and place", tears_finite));
  return all;
}

} // namespace rend
