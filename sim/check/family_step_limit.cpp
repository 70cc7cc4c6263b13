// How large a step may be: predicted from matrices, and found by running.
#include "sim/check/bisection.h"
#include "sim/check/families.h"
#include "sim/check/sketch.h"
#include "sim/check/step_limit.h"

#include <fmt/format.h>

#include <cmath>

namespace rend {
namespace {

struct Specimen {
  std::string name, body; // without what damps
  double fastest;         // about [1/s]
};

std::vector<Specimen> specimens() {
  return {
      {"spring chain",
       "    <sheet cells=\"1 6\" size=\"0.2 1\"/>\n    <mass total=\"0.12\"/>\n"
       "    <springs><stretch k=\"100\"/></springs>\n    <fix side=\"+y\"/>\n",
       200},
      {"spring sheet",
       "    <sheet pattern=\"triangles\" cells=\"3 3\" size=\"1 1\"/>\n    <mass total=\"0.1\"/>\n"
       "    <springs><stretch k=\"60\"/><shear k=\"43\"/><bend kind=\"angular\" k=\"0.02\"/></springs>\n"
       "    <fix near=\"0 1 0\"/>\n",
       300},
      {"hexahedra, corotational",
       "    <bar pattern=\"hexahedra\" cells=\"4 2 2\" size=\"1 0.4 0.4\"/>\n    <mass density=\"1000\"/>\n"
       "    <elasticity model=\"corotational\" young=\"1e5\" poisson=\"0.3\"/>\n    <fix side=\"-x\"/>\n",
       200},
      {"tetrahedra, linear",
       "    <bar pattern=\"tetrahedra\" cells=\"4 2 2\" size=\"1 0.4 0.4\"/>\n    <mass density=\"1000\"/>\n"
       "    <elasticity model=\"linear\" young=\"1e5\" poisson=\"0.3\"/>\n    <fix side=\"-x\"/>\n",
       200},
      {"hexahedra, mass-tensor",
       "    <bar pattern=\"hexahedra\" cells=\"3 2 2\" size=\"1 0.4 0.4\"/>\n    <mass density=\"1000\"/>\n"
       "    <elasticity model=\"mass-tensor\" young=\"1e5\" poisson=\"0.3\"/>\n",
       200}};
}

// What damps: nothing; the surroundings, each particle alike or by its mass; the material (which does so most where it
// swings fastest).
struct Damping {
  std::string name, springs, elasticity, body; // put into <stretch>, into <elasticity>; an element
};

std::vector<Damping> dampings() {
  return {{"undamped", "", "", ""},
          {"by mass", "", "", "    <viscosity value=\"20\" per=\"body\"/>\n"},
          {"by particle", "", "", "    <viscosity value=\"0.05\"/>\n"},
          {"by stiffness", " damping=\"0.2\"", " damping-stiffness=\"4e-3\"", ""}};
}

std::string with(std::string body, const std::string& before, const std::string& text) {
  for (std::size_t at = body.find(before); !text.empty() && at != std::string::npos;
       at = body.find(before, at + before.size() + text.size()))
    body.insert(at + before.size(), text);
  return body;
}

void compare(const Scheme& scheme, const Bench& bench, Finding& finding) {
  const std::string first = "1e-6";
  const Trial trial = bench.open({{"time.step", first}});
  Linearised linear(trial.body(), 0);
  const StepLimit predicted = step_limit(scheme, linear);
  if (predicted.step == 0) {
    try {
      bench.open({{"time.step", "auto"}});
      finding.verdict = Verdict::Failed;
      finding.what = "step=\"auto\" was accepted where no step is stable";
    } catch (const UserError& error) {
      finding.verdict = Verdict::Refused;
      finding.what = error.what();
      finding.why = error.hint;
    }
    return;
  }
  const double found = bisected_limit(bench, predicted.omega);
  finding.what = fmt::format("predicted {:.6g} s, found {:.6g} s; highest frequency {:.6g}/s", predicted.step,
                             found, predicted.omega);
  finding.within("predicted step over the one found", predicted.step / found, 0.99, 1.01);
  const Trial automatic = bench.open({{"time.step", "auto"}});
  finding.at_most("automatic step over the one found", automatic->step_size() / found, 1.0);
}

CheckCase limit_case(const Specimen& specimen, const Damping& damping, const Scheme& scheme) {
  Sketch sketch;
  sketch.body =
      with(with(specimen.body, "<stretch", damping.springs), "<elasticity", damping.elasticity) + damping.body;
  sketch.time = time_of(scheme.name, "1e-6", 1);
  CheckCase one;
  one.name = fmt::format("step-limit/{}/{}/{}", specimen.name, damping.name, scheme.name);
  one.expectation =
      "the predicted limit lies within 1 % of the largest step whose runs (from small random velocities, set "
      "on the scene; 4000 steps) do not grow, and step=\"auto\" lies below";
  one.preset = sketch.text();
  one.row = fmt::format("{}, {}", specimen.name, damping.name);
  one.column = scheme.name;
  one.quick = specimen.name == "spring chain" && damping.name != "by particle";
  one.run = [&scheme](const Bench& bench, Finding& finding) { compare(scheme, bench, finding); };
  return one;
}

std::vector<CheckCase> cases() {
  std::vector<CheckCase> all;
  for (const Specimen& specimen : specimens())
    for (const Damping& damping : dampings())
      for (const Scheme& scheme : all_schemes())
        if (!scheme.solves) all.push_back(limit_case(specimen, damping, scheme));
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
          cases};
}

} // namespace rend
