// The largest stable step: predicted from matrices, and found by running.
#include "sim/check/bisection.h"
#include "sim/check/families.h"
#include "sim/check/sketch.h"
#include "sim/check/step_limit.h"
#include "sim/check/watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

// Damping is chosen so that the highest modes have about 0.3 of critical damping: below a tenth of it, growth
// just above the limit of explicit Euler takes more steps to show than can be run.
struct Specimen {
  std::string name, body;                             // body: without its damping
  double by_mass, by_particle, of_springs, of_matter; // [N s/m] of the body and of each vertex; [N s/m]; β [s]
};

std::vector<Specimen> specimens() {
  const auto solid = [](const std::string& pattern, const std::string& model) {
    return Specimen{
        pattern + ", " + model,
        fmt::format("    <bar pattern=\"{}\" cells=\"3 1 1\" size=\"1 0.4 0.4\"/>\n"
                    "    <mass density=\"1000\"/>\n"
                    "    <elasticity model=\"{}\" young=\"1e5\" poisson=\"0.3\"/>\n    <fix side=\"-x\"/>\n",
                    pattern, model),
        1e4,
        800,
        0,
        6e-3};
  };
  return {{"chain of springs",
           "    <sheet cells=\"1 6\" size=\"0.2 1\"/>\n    <mass total=\"0.12\"/>\n"
           "    <springs><stretch k=\"100\"/></springs>\n    <fix side=\"+y\"/>\n",
           14, 0.8, 0.3, 0},
          {"sheet of springs",
           "    <sheet pattern=\"triangles\" cells=\"3 3\" size=\"1 1\"/>\n    <mass total=\"0.1\"/>\n"
           "    <springs><stretch k=\"60\"/><bend kind=\"angular\" k=\"0.02\"/></springs>\n    <fix near=\"0 1 "
           "0\"/>\n",
           17, 1, 0.12, 0},
          solid("hexahedra", "corotational"),
          solid("tetrahedra", "linear"),
          solid("hexahedra", "mass-tensor")};
}

std::string inserted(std::string body, const std::string& after, const std::string& text) {
  const std::size_t at = body.find(after);
  return at == std::string::npos ? body : body.insert(at + after.size(), text);
}

const std::vector<std::string> dampings{"undamped", "by mass", "by particle", "by stiffness"};

std::string damped(const Specimen& s, const std::string& how) {
  if (how == "by mass") return s.body + fmt::format("    <viscosity value=\"{}\" per=\"body\"/>\n", s.by_mass);
  if (how == "by particle") return s.body + fmt::format("    <viscosity value=\"{}\"/>\n", s.by_particle);
  if (how == "undamped") return s.body;
  const std::string springs = inserted(s.body, "<stretch", fmt::format(" damping=\"{}\"", s.of_springs));
  const std::string hinges = inserted(springs, "kind=\"angular\"", " damping=\"4e-5\"");
  return inserted(hinges, "<elasticity", fmt::format(" damping-stiffness=\"{}\"", s.of_matter));
}

// step="auto" is refused with a hint, or is below the step that was found [s].
void ask_for_automatic(const Bench& bench, double found, Finding& finding) {
  try {
    const Trial trial = bench.open({{"time.step", "auto"}});
    finding.at_most("automatic step over the one found", trial->step_size() / found, 1);
  } catch (const UserError& error) {
    if (error.code != Exit::BadInput || error.hint.empty()) throw;
    finding.why = std::string("step=\"auto\": ") + error.what() + "; " + error.hint;
    if (found == 0) finding.verdict = Verdict::Refused;
  }
}

void compare(const Scheme& scheme, const Bench& bench, Finding& finding) {
  const Trial trial = bench.open();
  Linearised linear(trial.body(), 0);
  const StepLimit predicted = step_limit(scheme, linear);
  if (predicted.step == 0) { // growth too slow to show in a run is unstable all the same
    finding.what = "no step is stable";
    ask_for_automatic(bench, 0, finding);
    return;
  }
  const double found = bisected_limit(bench, predicted.step);
  finding.what = fmt::format("predicted {:.5g} s, found {:.5g} s; highest frequency {:.6g}/s", predicted.step,
                             found, predicted.omega);
  finding.within("predicted step over the one found", predicted.step / found, 0.99, 1.01);
  ask_for_automatic(bench, found, finding);
}

CheckCase linear_case(const Specimen& specimen, const std::string& damping, const Scheme& scheme) {
  Sketch sketch;
  sketch.body = damped(specimen, damping);
  sketch.time = time_of(scheme.name, "1e-6", 1);
  CheckCase one;
  one.name = fmt::format("step-limit/{}/{}/{}", specimen.name, damping, scheme.name);
  one.expectation =
      "the predicted limit lies within 1 % of the largest step whose runs (4000 steps, from small random "
      "velocities that are not in the preset file) do not grow; step=\"auto\" lies below, or is refused with "
      "what would work";
  one.preset = sketch.text();
  one.row = specimen.name + ", " + damping;
  one.column = scheme.name;
  one.quick = specimen.name == "chain of springs" && damping != "by particle";
  one.run = [&scheme](const Bench& bench, Finding& finding) { compare(scheme, bench, finding); };
  return one;
}

// Large motions: a horizontal body is released.
struct Mover {
  std::string name, body;
  double duration, least; // [s]; `least`: a step that resolves everything
};

std::vector<Mover> movers() {
  return {
      {"cloth of springs",
       "    <sheet cells=\"5 5\" size=\"1 1\"/>\n    <mass total=\"0.1\"/>\n    <springs><stretch k=\"60\"/>"
       "<shear k=\"43\"/></springs>\n    <fix near=\"0 1 0\"/>\n    <fix near=\"1 1 0\"/>\n",
       1.5, 5e-4},
      {"bar, corotational",
       "    <bar pattern=\"hexahedra\" cells=\"6 1 1\" size=\"1 0.15 0.15\"/>\n    <mass density=\"1000\"/>\n"
       "    <elasticity model=\"corotational\" young=\"1e5\" poisson=\"0.3\"/>\n    <fix side=\"-x\"/>\n",
       3, 5e-4}};
}

struct Swing {
  double kinetic = 0;                                     // [J], the maximum
  double limit = std::numeric_limits<double>::infinity(); // [s], the minimum of those predicted along the way
};

Swing reference(const Scheme& scheme, const Bench& bench) {
  const Trial trial = bench.open();
  Swing swing;
  const long steps = std::lround(trial->duration() / trial->step_size()), every = std::max(1L, steps / 25);
  for (long n = 0; n < steps; ++n) {
    if (n % every == 0) {
      swing.kinetic = std::max(swing.kinetic, trial->kinetic_energy());
      Linearised linear(trial.body(), trial->time());
      swing.limit = std::min(swing.limit, step_limit(scheme, linear).step);
    }
    trial->step();
  }
  return swing;
}

// Energy does not increase, to a fifth of the kinetic energy.
bool keeps_energy(const Bench& bench, double step, double kinetic) {
  const Trial trial = bench.open({{"time.step", fmt::format("{}", step)}}, unguarded());
  const double start = energy(*trial.scene);
  const long steps = static_cast<long>(trial->duration() / step);
  try {
    for (long n = 0; n < steps; ++n) {
      trial->step();
      if (n % 8 == 0 && !(energy(*trial.scene) <= start + 0.2 * kinetic)) return false;
    }
  } catch (const Unstable&) {
    return false;
  }
  return true;
}

CheckCase large_case(const Mover& mover, const Scheme& scheme) {
  Sketch sketch;
  sketch.body = mover.body;
  sketch.gravity = "0 0 -9.81";
  sketch.time = time_of(scheme.name, in_short(mover.least), mover.duration);
  CheckCase one;
  one.name = fmt::format("step-limit/large motion/{}/{}", mover.name, scheme.name);
  one.expectation =
      "falls from where it is held: the least limit that is predicted from the states of a run with a small "
      "step lies within 20 % of the largest step with which no energy appears";
  one.preset = sketch.text();
  one.row = mover.name + ", large motion";
  one.column = scheme.name;
  one.run = [&scheme](const Bench& bench, Finding& finding) {
    const Swing swing = reference(scheme, bench);
    double low = swing.limit / 4, high = swing.limit * 4;
    while (high > 1.01 * low) {
      const double middle = std::sqrt(low * high);
      (keeps_energy(bench, middle, swing.kinetic) ? low : high) = middle;
    }
    finding.what = fmt::format("predicted {:.5g} s, found {:.5g} s", swing.limit, low);
    finding.within("predicted step over the one found", swing.limit / low, 0.8, 1.2);
  };
  return one;
}

std::vector<CheckCase> step_limit_cases() {
  std::vector<CheckCase> all;
  for (const Specimen& specimen : specimens())
    for (const std::string& damping : dampings)
      for (const Scheme& scheme : all_schemes())
        if (!scheme.solves && !scheme.adaptive) all.push_back(linear_case(specimen, damping, scheme));
  for (const Mover& mover : movers())
    for (const Scheme& scheme : all_schemes())
      if (!scheme.solves && !scheme.adaptive && scheme.limit({1, 0, 0}) > 0)
        all.push_back(large_case(mover, scheme));
  return all;
}

} // namespace

CheckFamily step_limit_family() {
  return {"step-limit", "The largest stable step",
          "Predicted: the highest frequency of the assembled stiffness (Lanczos), and where the scheme's own "
          "amplification "
          "of the linearised body, damping included, passes 1. Found: by bisection over runs, without anything "
          "that "
          "would rescue a step. Where no step is stable, step=\"auto\" must be refused.",
          step_limit_cases};
}

} // namespace rend
