// Stiffness over nine decades, with every scheme: a chain of springs and a bar hang by their own weight, come
// to rest, and have the length given by statics: (m g/k) N²/2, and ρ g L²/(2 E). Both are exact for these
// models on any mesh.
#include "sim/check/families.h"
#include "sim/check/sketch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

// A displacement of dt v below half a unit in the last place is lost: a motion that decays with 1/ω stops 1/(dt
// ω) units away.
constexpr double hanging_g = 9.81, rounded = 2e-15; // [m/s²]; [m]: some units in the last place of 1 m
// [m]: for adaptive schemes, whose substeps have a tolerance of 1e-6 of the size
constexpr double tolerance = 2e-6;
constexpr int links = 10;

// Masses m of 10 g, the last of half as much; the lowest frequency is 2 √(k/m) sin(π/4N).
struct Hanging {
  const char* name;
  double extension; // [m]
  double slowest;   // [1/s], lowest frequency
  std::string body; // without its damping
};

Hanging chain(double k) {
  constexpr double m = 0.01;
  return {"chain", m * hanging_g / k * links * links / 2, 2 * std::sqrt(k / m) * std::sin(M_PI / (4 * links)),
          fmt::format("    <sheet cells=\"1 {}\" size=\"0.2 1\"/>\n    <place rotate=\"90 0 0\"/>\n"
                      "    <mass total=\"{}\"/>\n    <springs><stretch k=\"{}\"/></springs>\n",
                      links, in_short(2 * m * links), in_short(k))};
}

Hanging bar(double young) {
  return {
      "bar", hanging_g / (2 * young), M_PI / 2 * std::sqrt(young),
      fmt::format(
          "    <bar pattern=\"hexahedra\" cells=\"1 1 4\" size=\"0.2 0.2 1\"/>\n"
          "    <mass density=\"1\"/>\n    <elasticity model=\"corotational\" young=\"{}\" poisson=\"0\"/>\n",
          in_short(young))};
}

double mass_of(const Hanging& what) {
  return std::string(what.name) == "chain" ? 0.02 * links : 0.04;
}

CheckCase hang(const Hanging& what, const Scheme& scheme, int exponent) {
  const bool rests = scheme.name == "static";
  const double duration = rests ? 1 : scheme.solves ? 2 : 40 / what.slowest;
  Sketch sketch;
  sketch.gravity = "0 0 -9.81";
  sketch.body =
      what.body +
      fmt::format("    <viscosity value=\"{}\" per=\"body\"/>\n", in_short(2 * what.slowest * mass_of(what))) +
      "    <fix side=\"+z\"/>\n    <probe name=\"end\" side=\"-z\"/>\n";
  sketch.time = time_of(scheme.name,
                        rests                              ? "1"
                        : scheme.solves || scheme.adaptive ? "0.01"
                                                           : "auto",
                        duration);
  CheckCase one;
  one.name = fmt::format("stiffness/{}/{}/{}", what.name, scheme.name, decade(exponent));
  sketch.name = fmt::format("stiffness-{}-{}-{}", what.name, scheme.name, decade(exponent));
  one.expectation =
      fmt::format("hangs at rest, longer by {:.6g} m, to 1e-6 of it or what rounding 1 m makes of it: 2e-15 m, "
                  "and more where steps are so short that the last moves are less than that",
                  what.extension);
  one.preset = sketch.text();
  one.row = fmt::format("{}, {}", what.name, scheme.name);
  one.column = decade(exponent);
  one.quick = exponent == 12 || (exponent == 3 && scheme.name == "symplectic");
  one.run = [extension = what.extension, slowest = what.slowest, adaptive = scheme.adaptive](const Bench& bench,
                                                                                             Finding& finding) {
    const Trial trial = bench.open();
    const long steps = std::lround(trial->duration() / trial->step_size());
    for (long n = 0; n < steps; ++n) trial->step();
    const auto reading = trial.body().probes[0].read(trial.body());
    const double lost = adaptive ? tolerance : rounded * std::max(1.0, 1 / (slowest * trial->step_size()));
    finding.near("extension [m]", reading ? -reading->displacement.z() : NAN, extension,
                 1e-6 * extension + lost);
    finding.what = fmt::format("{} steps of {:.3g} s", steps, trial->step_size());
  };
  return one;
}

std::vector<CheckCase> stiffness_cases() {
  std::vector<CheckCase> all;
  for (const auto make : {chain, bar})
    for (const Scheme& scheme : all_schemes())
      for (const int exponent : {3, 6, 9, 12})
        all.push_back(hang(make(std::pow(10, exponent)), scheme, exponent));
  return all;
}

} // namespace

CheckFamily stiffness_family() {
  return {"stiffness", "Stiffness",
          "k [N/m] of a chain of ten springs, E [Pa] of a co-rotational bar, from 1e3 to 1e12 under every "
          "scheme: explicit "
          "ones with their automatic step, implicit with one of 10 ms that resolves nothing, static in one. "
          "They hang by "
          "their weight, damped as fast as they can come to rest; the length there is exact, (m g/k) N^2/2 and "
          "rho g L^2/(2 E).",
          stiffness_cases};
}

} // namespace rend
