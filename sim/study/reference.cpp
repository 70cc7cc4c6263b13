#include "sim/study/reference.h"

#include "sim/study/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace rend {
namespace {

// relative to the motion: the round-off of thousands of steps in double precision
constexpr double round_off = 1e-12;
constexpr double reference_tolerance = 1e-13; // tolerance

struct Attempt {
  SampledRun run;
  double step = 0; // [s]
};

Attempt attempt(const MakeScene& make, const StudyGroup& group, Variant variant, double duration, long steps,
                const StudyCalls& calls) {
  variant.step = duration / static_cast<double>(steps);
  variant.settings = group.settings;
  const auto scene = make(variant);
  return {sampled_run(*scene, steps, calls.going), variant.step};
}

double distance(const Trajectory& a, const Trajectory& b, const Scales& scales) {
  const double until = std::min(a.first_tear.value_or(std::numeric_limits<double>::infinity()),
                                b.first_tear.value_or(std::numeric_limits<double>::infinity()));
  const auto errors = compare(a, b, until);
  return errors ? errors->position.over_time / scales.length : std::numeric_limits<double>::infinity();
}

[[noreturn]] void fail(const Attempt& one) {
  throw UserError(
      Exit::Unstable, {},
      fmt::format("there is nothing to compare with: even at steps of {:.3g} s {}", one.step, one.run.reason),
      "Study a shorter stretch (--duration), or see with 'rend run' what goes wrong.");
}

std::size_t elements_of(const Scene& scene) {
  std::size_t count = 0;
  for (const auto& body : scene.bodies())
    count += body->map->use(element_orbit(body->map->dimension())).count();
  return count;
}

// From the first to the last, each four times the previous.
std::vector<long> numbers_of_steps(long first, long last) {
  std::vector<long> all;
  for (long count = first; count < last; count *= 4) all.push_back(count);
  all.push_back(last);
  return all;
}

} // namespace

Reference make_reference(const MakeScene& make, const StudyGroup& group, double duration, int steps,
                         const StudyCalls& calls) {
  Variant variant;
  variant.integrator = "rk4";
  variant.step = duration / study_samples;
  variant.settings = group.settings;
  Reference reference;
  StudyReference& figures = reference.figures;
  const auto probe = make(variant);
  figures.elements = elements_of(*probe);
  for (const auto& body : probe->bodies()) figures.vertices += body->map->cells(Vertex).count();
  const std::vector<Knob> sweep =
      sweep_of(*find_scheme("rk4"), *probe, {.duration = duration, .steps = steps, .above_limit = false});
  const long coarse = tears(*probe) ? steps_within(duration, natural_step(*probe, duration)) : study_samples;

  if (calls.progress) calls.progress("reference, second scheme", 0);
  Variant other = variant;
  other.integrator = "rk45";
  other.tolerance = reference_tolerance;
  const Attempt second = attempt(make, group, other, duration, coarse, calls);
  if (second.run.outcome != Outcome::Done) fail(second);
  figures.second = fmt::format("rk45, tolerance {:g}", reference_tolerance);
  figures.second_step =
      duration / static_cast<double>(std::max(second.run.counts.substeps, second.run.steps_done));
  figures.second_first_tear = second.run.trajectory.first_tear;
  figures.scheme = "rk4";
  figures.bar = std::numeric_limits<double>::infinity();
  for (long count : numbers_of_steps(8 * sweep.front().steps, 8 * sweep.back().steps)) {
    if (calls.progress) calls.progress(fmt::format("reference, rk4 at {} steps", count), 0);
    Attempt first = attempt(make, group, variant, duration, count, calls);
    if (first.run.outcome != Outcome::Done) fail(first);
    const Scales scales = scales_of(first.run.trajectory);
    const double bar = distance(first.run.trajectory, second.run.trajectory, scales);
    const bool better = bar < 0.5 * figures.bar;
    figures.step = first.step;
    figures.bar = bar;
    figures.scales = scales;
    reference.trajectory = std::move(first.run.trajectory);
    if (bar <= round_off || !better) break;
  }
  figures.first_tear = reference.trajectory.first_tear;
  figures.tears = reference.trajectory.tear_count;
  figures.torn_overlap = overlap(reference.trajectory.torn, second.run.trajectory.torn);
  return reference;
}

} // namespace rend
