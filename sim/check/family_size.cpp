// From a micrometre to a thousand kilometres: with everything else scaled accordingly, only round-off may
// differ.
#include "sim/check/families.h"
#include "sim/check/sketch.h"
#include "sim/check/watch.h"

#include <fmt/format.h>

#include <cmath>

namespace rend {
namespace {

// Scaled from 1 m to length L: density and E are constant, so that time scales with L, and gravity with 1/L.
struct Scaled {
  std::string name;
  std::string (*body)(double L);
};

std::string springs(double L) {
  return fmt::format(
      "    <sheet pattern=\"mixed\" cells=\"4 4\" size=\"{0} {0}\"/>\n    <mass total=\"{1}\"/>\n"
      "    <springs><stretch k=\"{2}\"/><shear k=\"{2}\"/><bend kind=\"provot\" k=\"{3}\"/></springs>\n"
      "    <fix side=\"-x\"/>\n    <probe name=\"end\" side=\"+x\"/>\n",
      in_short(L), in_short(0.1 * L * L * L), in_short(60 * L), in_short(10 * L));
}
std::string hinges(double L) {
  return fmt::format(
      "    <sheet pattern=\"triangles\" cells=\"4 2\" size=\"{0} {1}\"/>\n    <mass total=\"{2}\"/>\n"
      "    <springs><stretch k=\"{3}\"/><bend kind=\"angular\" k=\"{4}\"/></springs>\n"
      "    <fix box=\"-1e-9 -1e9 -1 {5} 1e9 1\"/>\n    <probe name=\"end\" side=\"+x\"/>\n",
      in_short(L), in_short(L / 2), in_short(0.1 * L * L * L), in_short(60 * L), in_short(0.05 * L * L * L),
      in_short(0.3 * L));
}
std::string scaled_bar(double L, const char* pattern, const char* model) {
  return fmt::format(
      "    <bar pattern=\"{}\" cells=\"5 1 1\" size=\"{} {} {}\"/>\n    <mass density=\"1000\"/>\n"
      "    <elasticity model=\"{}\" young=\"2e5\" poisson=\"0.3\"/>\n    <fix side=\"-x\"/>\n"
      "    <probe name=\"end\" side=\"+x\"/>\n",
      pattern, in_short(L), in_short(0.2 * L), in_short(0.15 * L), model);
}
std::string torn(double L) {
  return fmt::format("    <sheet pattern=\"triangles\" cells=\"4 4\" size=\"{0} {0}\"/>\n    <mass "
                     "density=\"1000\" thickness=\"{1}\"/>\n"
                     "    <elasticity model=\"corotational\" young=\"1e6\" poisson=\"0.3\" thickness=\"{1}\" "
                     "damping-mass=\"{2}\"/>\n"
                     "    <fix side=\"-x\"/>\n    <drive side=\"+x\" velocity=\"2 0 0\"/>\n"
                     "    <tear criterion=\"vertex-stress\" threshold=\"1e5\"/>\n    <probe name=\"end\" "
                     "near=\"{3} {3} 0\"/>\n",
                     in_short(L), in_short(0.01 * L), in_short(20 / L), in_short(0.5 * L));
}

std::vector<Scaled> scaled_bodies() {
  return {{"springs, mixed cells", springs},
          {"angular hinges", hinges},
          {"corotational tetrahedra", [](double L) { return scaled_bar(L, "tetrahedra", "corotational"); }},
          {"corotational, mixed elements", [](double L) { return scaled_bar(L, "mixed", "corotational"); }},
          {"linear hexahedra", [](double L) { return scaled_bar(L, "hexahedra", "linear"); }},
          {"mass-tensor tetrahedra", [](double L) { return scaled_bar(L, "tetrahedra", "mass-tensor"); }},
          {"torn sheet", torn}};
}

std::string text_of(const Scaled& what, double L, const std::string& scheme) {
  Sketch sketch;
  sketch.body = what.body(L);
  sketch.gravity = fmt::format("0 0 {}", in_short(-9.81 / L));
  // the same number of steps for all L: in units of L; implicit and static need the step itself
  sketch.time =
      time_of(scheme, scheme == "symplectic" || scheme == "rk4" ? "auto" : in_short(0.01 * L), 0.25 * L);
  return sketch.text();
}

struct Path {
  std::vector<double> at; // the end's displacement over L, along each axis at each tenth
  std::size_t tears = 0;
};
Path followed(const Trial& trial, double L) {
  Path path;
  const long steps = std::lround(trial->duration() / trial->step_size());
  for (long n = 0; n < steps; ++n) {
    trial->step();
    if (n % std::max(1L, steps / 10) != 0) continue;
    const auto reading = trial.body().probes[0].read(trial.body());
    for (int axis = 0; axis < 3; ++axis) path.at.push_back(reading ? reading->displacement[axis] / L : NAN);
  }
  path.tears = trial->tears();
  return path;
}

CheckCase size_case(const Scaled& what, int exponent, const std::string& scheme) {
  CheckCase one;
  const double L = std::pow(10.0, exponent);
  one.name = fmt::format("size/{}/{}/{}", what.name, scheme, decade(exponent));
  one.expectation =
      fmt::format("moves as the one of 1 m does, in units of its length and of the time that sound takes along "
                  "it: the same tears, the same path to {} of its length",
                  scheme == "implicit" ? "2e-3 (a step is solved to 1e-5 of its forces)" : "1e-7");
  one.preset = text_of(what, L, scheme);
  one.row = fmt::format("{}, {}", what.name, scheme);
  one.column = decade(exponent) + " m";
  one.quick = exponent == -6 && scheme == "symplectic";
  const std::string unit = text_of(what, 1, scheme);
  const double error = scheme == "implicit" ? 2e-3 : 1e-7;
  one.run = [L, unit, error](const Bench& bench, Finding& finding) {
    const Path there = followed(bench.open(), L), here = followed(bench.open_text(unit), 1);
    double worst = there.at.size() == here.at.size() ? 0 : NAN, most = 0;
    for (std::size_t n = 0; n < here.at.size() && n < there.at.size(); ++n) {
      worst = std::max(worst, std::abs(there.at[n] - here.at[n]));
      most = std::max(most, std::abs(here.at[n]));
    }
    finding.at_most("difference of the paths over L", worst, error);
    finding.at_least("way of the one of 1 m [m]", most, 1e-3);
    finding.near("tears", static_cast<double>(there.tears), static_cast<double>(here.tears), 0);
    if (here.tears > 0) finding.what = fmt::format("{} tears each", here.tears);
  };
  return one;
}

std::vector<CheckCase> size_cases() {
  std::vector<CheckCase> all;
  for (const Scaled& what : scaled_bodies())
    for (const char* scheme : {"symplectic", "rk4", "implicit"})
      for (const int exponent : {-6, -3, 3, 6}) all.push_back(size_case(what, exponent, scheme));
  return all;
}

} // namespace

CheckFamily size_family() {
  return {"size", "From a micrometre to a thousand kilometres",
          "Bodies of 1e-6 to 1e6 m, with masses, stiffnesses, gravity and time scaled along. In units of their "
          "length they "
          "must do what the one of 1 m does: any constant with a dimension that is hidden in the program would "
          "show here.",
          size_cases};
}

} // namespace rend
