#include "sim/study/runs.h"

#include "sim/base/check.h"
#include "sim/study/sweep.h"

#include <algorithm>
#include <cmath>
#include <ctime>

namespace rend {
namespace {

constexpr long asked_every = 64; // steps between calls of `going`

void ask(const std::function<bool()>& going, long step) {
  if (going && step % asked_every == 0 && !going()) throw StopRequested{};
}

RunCounts counts_of(const Scene& scene) {
  RunCounts counts;
  for (const auto& body : scene.bodies()) {
    const SolverFigures solver = body->integrator->solver();
    counts.newton += solver.newton;
    counts.cg += solver.cg;
    counts.factorisations += solver.factorisations;
    counts.substeps += solver.substeps;
    counts.rejected += solver.rejected;
  }
  counts.evaluations = scene.evaluations();
  return counts;
}

// The reason of a failure, without its place in the preset.
std::string short_reason(const std::string& what) {
  const std::size_t at = what.find("the simulation was stopped");
  return at == std::string::npos ? what : what.substr(at);
}

bool finite(const StateSample& sample) {
  return std::isfinite(sample.energy()) && sample.momentum.allFinite();
}

} // namespace

double thread_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

SampledRun sampled_run(Scene& scene, long steps, const std::function<bool()>& going) {
  CHECK(steps >= 1);
  SampledRun run;
  Sampler sampler(scene);
  const long every = steps >= study_samples ? steps / study_samples : 1;
  const double start = thread_seconds();
  sampler.take(scene);
  try {
    for (long n = 1; n <= steps; ++n) {
      ask(going, n);
      scene.step();
      if (n % every != 0 && n != steps) continue;
      scene.check_sound();
      sampler.take(scene);
    }
  } catch (const Unstable& error) {
    run.outcome = scene.scheme().solves ? Outcome::NotConverged : Outcome::Unstable;
    run.reason = short_reason(error.what());
  }
  run.seconds = thread_seconds() - start;
  run.steps_done = scene.steps_done();
  run.counts = counts_of(scene);
  run.trajectory = sampler.finish(scene);
  if (run.outcome == Outcome::Done && !finite(run.trajectory.samples.back())) {
    run.outcome = Outcome::Unstable;
    run.reason = "its energy or momentum is not finite";
  }
  return run;
}

double timed_run(Scene& scene, long steps, const std::function<bool()>& going) {
  const double start = thread_seconds();
  for (long n = 1; n <= steps; ++n) {
    ask(going, n);
    scene.step();
  }
  return thread_seconds() - start;
}

RunTime summary_of(std::vector<double> seconds) {
  CHECK(!seconds.empty());
  std::sort(seconds.begin(), seconds.end());
  // Linear between order statistics (Hyndman & Fan 1996, type 7).
  const auto quantile = [&](double share) {
    const double at = share * static_cast<double>(seconds.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    const std::size_t above = std::min(below + 1, seconds.size() - 1);
    return seconds[below] + (at - static_cast<double>(below)) * (seconds[above] - seconds[below]);
  };
  return {quantile(0.5), seconds.front(), seconds.back(), quantile(0.75) - quantile(0.25),
          static_cast<int>(seconds.size())};
}

} // namespace rend
