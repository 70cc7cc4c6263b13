// Blocks that rest on the floor, and on slopes by friction.
#include "sim/check/families.h"
#include "sim/check/sketch.h"

#include <fmt/format.h>

#include <cmath>

namespace rend {
namespace {

constexpr double rest_g = 9.81, block_mass = 10;        // [m/s²], [kg]
constexpr double block_width = 0.4, block_height = 0.2; // [m]

// With ν = 0 each column of it carries its own weight alone.
Sketch block_sketch(double young, double friction, double drag) {
  Sketch sketch;
  sketch.body = fmt::format(
      "    <bar cells=\"4 4 2\" size=\"{0} {0} {1}\"/>\n    <place translate=\"0 0 0.002\"/>\n"
      "    <mass total=\"{2}\"/>\n    <elasticity young=\"{3}\" poisson=\"0\" damping-stiffness=\"0.003\"/>\n"
      "    <viscosity value=\"{4}\" per=\"body\"/>\n    <contact with=\"floor\" friction=\"{5}\"/>\n"
      "    <probe name=\"top\" side=\"+z\"/>\n    <probe name=\"bottom\" side=\"-z\"/>\n",
      in_short(block_width), in_short(block_height), in_short(block_mass), in_short(young), in_short(drag),
      in_short(friction));
  sketch.world = "<floor z=\"0\"/>";
  return sketch;
}

Vec3 moved_by(const Trial& trial, std::size_t probe) {
  const auto reading = trial.body().probes[probe].read(trial.body());
  return reading ? reading->displacement : Vec3(Vec3::Constant(NAN));
}

// ρ g h²/2E, whatever the scheme and the step.
CheckCase rest_case(const Scheme& scheme, const std::string& step, int exponent) {
  const double young = std::pow(10.0, exponent);
  const double known = block_mass * rest_g * block_height / (2 * young * block_width * block_width);
  Sketch sketch = block_sketch(young, 0.5, 50);
  sketch.gravity = "0 0 -9.81";
  sketch.time = time_of(scheme.name, step, scheme.name == "static" ? 0.2 : 6);
  CheckCase one;
  one.name = fmt::format("rest/block/{}/{}/{}", scheme.name, step, decade(exponent));
  one.expectation = fmt::format(
      "a block of {} kg and {} Pa lies on the floor: lower by {:.4g} m at its top than at its bottom, to 1 %",
      in_short(block_mass), decade(exponent), known);
  one.preset = sketch.text();
  one.row = fmt::format("block, {}, step {}", scheme.name, step);
  one.column = decade(exponent);
  one.quick = exponent == 5 && (step == "0.03" || scheme.name == "static");
  const bool scheme_falls = scheme.name == "verlet";
  one.run = [known, scheme_falls](const Bench& bench, Finding& finding) {
    const Trial trial = bench.open();
    const long steps = std::lround(trial->duration() / trial->step_size());
    for (long n = 0; n < steps; ++n) trial->step();
    const double compression = moved_by(trial, 1).z() - moved_by(trial, 0).z();
    finding.near("compression [m]", compression, known, 0.01 * known);
    // What starts at rest under verlet falls in its first half step, and nothing pays to bring it back.
    const double h = trial->step_size(), fallen = scheme_falls ? rest_g * h * h / 2 : 0;
    finding.within("bottom above its place [m]", moved_by(trial, 1).z(), -fallen - 1e-9, 1e-6);
    finding.what = fmt::format("{} steps of {:.3g} s", steps, trial->step_size());
  };
  return one;
}

// Gravity is turned by θ = atan `slope`. It stands, or slides with g (sin θ − μ cos θ).
CheckCase slope_case(const Scheme& scheme, const std::string& step, double slope, bool stands) {
  const double angle = std::atan(slope), friction = slope * (stands ? 1.02 : 0.98);
  Sketch sketch = block_sketch(1e5, friction, 0);
  sketch.gravity =
      fmt::format("{} 0 {}", in_short(rest_g * std::sin(angle)), in_short(-rest_g * std::cos(angle)));
  sketch.time = time_of(scheme.name, step, 4);
  const double known = rest_g * (std::sin(angle) - friction * std::cos(angle));
  CheckCase one;
  one.name = fmt::format("rest/slope/{}/{}/{}", scheme.name, in_short(slope), stands ? "stands" : "slides");
  one.expectation =
      stands ? fmt::format("a block on a slope of {}, friction {:.4g}: it stands, and creeps by 1e-4 m "
                           "in 3 s at most",
                           in_short(slope), friction)
             : fmt::format("a block on a slope of {}, friction {:.4g}: it slides with {:.4g} m/s2, to "
                           "2 %",
                           in_short(slope), friction, known);
  one.preset = sketch.text();
  one.row = "slope, " + scheme.name;
  one.column = fmt::format("{} {}", in_short(slope), stands ? "stands" : "slides");
  one.quick = slope == 0.5;
  one.run = [known, stands](const Bench& bench, Finding& finding) {
    const Trial trial = bench.open();
    const auto go_on = [&](double until) {
      while (trial->time() < until - 1e-9) trial->step();
    };
    go_on(1);
    const double start = moved_by(trial, 1).x(), speed = trial->momentum().x() / block_mass;
    go_on(4);
    if (stands)
      finding.at_most("way in 3 s [m]", std::abs(moved_by(trial, 1).x() - start), 1e-4);
    else
      finding.near("acceleration [m/s2]", (trial->momentum().x() / block_mass - speed) / 3, known,
                   0.02 * known);
  };
  return one;
}

std::vector<CheckCase> rest_cases() {
  std::vector<CheckCase> all;
  for (const Scheme& scheme : all_schemes()) {
    const bool by_itself = scheme.name == "symplectic" || scheme.name == "verlet";
    if (!scheme.solves_contact && !by_itself) continue;
    const std::vector<std::string> steps = scheme.name == "static" ? std::vector<std::string>{"0.1"}
                                           : by_itself
                                               ? std::vector<std::string>{"auto"}
                                               : std::vector<std::string>{"0.001", "0.003", "0.01", "0.03"};
    for (const std::string& step : steps)
      for (const int exponent : by_itself ? std::vector{5} : std::vector{4, 5, 6, 8})
        all.push_back(rest_case(scheme, step, exponent));
    if (scheme.name == "static" || scheme.name == "verlet") continue;
    for (const double slope : {0.1, 0.5, 1.0})
      for (const bool stands : {true, false})
        all.push_back(slope_case(scheme, by_itself ? "auto" : "0.005", slope, stands));
  }
  return all;
}

} // namespace

CheckFamily rest_family() {
  return {
      "rest", "Blocks that rest and slide",
      "A block on the floor under every scheme that can hold it, with steps of 1 to 30 ms: it is compressed "
      "by its weight once. And on slopes a little below and above the angle of friction.",
      rest_cases};
}

} // namespace rend
