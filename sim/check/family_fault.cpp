// Fault injection: a number that is not finite in each stage of a step, once and at every attempt.
#include "sim/check/families.h"
#include "sim/check/sketch.h"
#include "sim/check/watch.h"

#include <fmt/format.h>

namespace rend {
namespace {

constexpr long fault_steps = 200, struck = 60;

CheckCase fault_case(const Scheme& scheme, StepStage stage, bool lasting) {
  Sketch sketch;
  sketch.body =
      "    <bar pattern=\"hexahedra\" cells=\"4 1 1\" size=\"1 0.2 0.2\"/>\n    <place translate=\"0 0 "
      "0.1\"/>\n"
      "    <mass density=\"1000\"/>\n"
      "    <elasticity model=\"corotational\" young=\"1e5\" poisson=\"0.3\" damping-mass=\"4\"/>\n"
      "    <fix side=\"-x\"/>\n    <load side=\"+x\" force=\"0 0 -20\"/>\n    <contact with=\"floor\"/>\n"
      "    <probe name=\"end\" side=\"+x\"/>\n";
  sketch.gravity = "0 0 -9.81";
  sketch.world = "<floor z=\"0\"/>";
  sketch.time = time_of(scheme.name, "2e-3", 1);
  CheckCase one;
  one.name = fmt::format("fault/{}/{}/{}", scheme.name, name_of(stage), lasting ? "lasting" : "once");
  one.expectation = lasting ? "a NaN at every try of step 60, however small: stopped as unstable, with the "
                              "time and the body named, and "
                              "the state of before whole"
                            : "a NaN in step 60 alone: redone, so that after 200 steps the end is where it is "
                              "without, to 1e-2 of its way";
  one.preset = sketch.text();
  one.row = scheme.name;
  one.column = fmt::format("{}, {}", name_of(stage), lasting ? "lasting" : "once");
  one.quick = scheme.name == "symplectic";
  one.run = [stage, lasting](const Bench& bench, Finding& finding) {
    SceneOptions options;
    options.fault = Fault{stage, struck, lasting};
    const Trial sound = bench.open(), trial = bench.open({}, options);
    const Course course = run(*trial.scene, fault_steps, fault_steps);
    finding.at_least("finite", is_finite(*trial.scene), 1);
    finding.what = course.why;
    if (lasting) {
      finding.at_least("stopped as unstable", course.stopped, 1);
      finding.at_least("names the body and the time",
                       course.why.find("body 'body'") != std::string::npos &&
                           course.why.find(" s (step ") != std::string::npos,
                       1);
      return;
    }
    run(*sound.scene, fault_steps, fault_steps);
    const auto end = [](const Trial& t) { return t.body().probes[0].read(t.body())->displacement; };
    finding.at_most("stopped as unstable", course.stopped, 0);
    finding.at_most("difference of the end over its way", (end(trial) - end(sound)).norm() / end(sound).norm(),
                    1e-2);
    finding.what = course.stopped ? course.why : fmt::format("{} steps redone", trial->guard().rejected);
  };
  return one;
}

std::vector<CheckCase> fault_cases() {
  std::vector<CheckCase> all;
  for (const Scheme& scheme : all_schemes()) {
    if (scheme.name == "static" || (scheme.solves && !scheme.solves_contact) || scheme.limit({1, 0, 0}) <= 0)
      continue; // has no motion; supports no contact; has no stable step
    for (const StepStage stage :
         {StepStage::Forces, StepStage::Loads, StepStage::Integration, StepStage::Contact})
      for (const bool lasting : {false, true}) all.push_back(fault_case(scheme, stage, lasting));
  }
  return all;
}

} // namespace

CheckFamily fault_family() {
  return {"fault", "A number that is none",
          "A NaN is put into each stage of one step of a loaded bar above a floor (not in the preset file). "
          "Once: the "
          "guard must redo "
          "the step and nothing is lost. At every try: the run must stop and say where, with its state whole.",
          fault_cases};
}

} // namespace rend
