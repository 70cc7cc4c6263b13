#include "sim/study/duration.h"

#include <fmt/format.h>

#include <cmath>

namespace rend {
namespace {

constexpr double usual = 0.2, usual_steps = 64, after_tear = 1.25, reach_for_answers = 10;

// When the preset, unmodified, first tears.
std::optional<double> first_tear(Scene& scene, const StudyCalls& calls) {
  try {
    while (scene.time() < scene.duration() && scene.tears() == 0) {
      if (calls.going && !calls.going()) throw StopRequested{};
      scene.step();
    }
  } catch (const Unstable&) {
    return {}; // the reference will report the error
  }
  if (scene.tears() == 0) return {};
  return scene.time();
}

double last_answer(const Scene& scene, double until) {
  double last = 0;
  for (const auto& body : scene.bodies())
    for (const Answer& answer : body->answers)
      if (answer.at <= until) last = std::max(last, answer.at);
  return last;
}

} // namespace

StudyDuration study_duration(const MakeScene& make, const std::vector<Setting>& settings,
                             const StudyCalls& calls) {
  Variant own;
  own.settings = settings;
  const auto scene = make(own);
  const double clip = scene->duration(), limit = scene->stability_limit(*find_scheme("symplectic"));
  StudyDuration stretch{usual, fmt::format("{:g} s, the usual stretch", usual)};
  if (std::isfinite(limit) && usual_steps * limit > usual)
    stretch = {usual_steps * limit, fmt::format("{:g} of symplectic's largest steps", usual_steps)};
  if (tears(*scene)) {
    if (calls.progress) calls.progress("looking for the first tear", 0);
    if (const auto torn = first_tear(*scene, calls))
      stretch = {after_tear * *torn, fmt::format("a quarter more than the {:.4g} s to the first tear", *torn)};
  }
  const double answer = last_answer(*scene, reach_for_answers * stretch.seconds);
  if (answer > 0 && !tears(*scene)) stretch = {answer, "up to the last answer of the preset that is near"};
  if (stretch.seconds >= clip) stretch = {clip, "the whole clip"};
  return stretch;
}

} // namespace rend
