// Mass ratios of a million: a light cell between heavy ones, and a heavy ball against a light sheet.
#include "sim/check/families.h"
#include "sim/check/sketch.h"
#include "sim/check/watch.h"

#include <fmt/format.h>

#include <cmath>

namespace rend {
namespace {

constexpr double ladder_g = 9.81, ladder_k = 1e3; // [m/s²], [N/m]

// A ladder 1 m wide, whose five cells are 1, r, 1, r, 1 m high, which are also their masses [kg]: each rung has
// half of the adjacent cells. It hangs by its two rails of springs, all of the same stiffness whatever their
// length.
struct Ladder {
  std::vector<double> heights; // [m]
  explicit Ladder(double r) : heights{1, r, 1, r, 1} {}

  std::string obj() const {
    std::string out = "v 0 0 0\nv 1 0 0\n";
    double z = 0;
    for (const double h : heights) {
      z -= h;
      out += fmt::format("v 0 0 {0}\nv 1 0 {0}\n", in_short(z));
    }
    for (std::size_t n = 0; n < heights.size(); ++n)
      out += fmt::format("f {} {} {} {}\n", 2 * n + 1, 2 * n + 2, 2 * n + 4, 2 * n + 3);
    return out;
  }
  double mass() const { // [kg]
    double sum = 0;
    for (const double h : heights) sum += h;
    return sum;
  }
  // Each cell's rails carry the rungs below it: the weight of the cells below, and half of its own.
  double extension() const { // [m]
    double sum = 0, below = 0;
    for (std::size_t n = heights.size(); n-- > 0;) {
      sum += (below + 0.5 * heights[n]) * ladder_g / (2 * ladder_k);
      below += heights[n];
    }
    return sum;
  }
};

CheckCase ladder_case(const Scheme& scheme, int exponent) {
  const Ladder ladder(std::pow(10.0, exponent));
  // [1/s]: three bodies of 1 kg on springs of 2000 N/m have frequencies of 20/s and more
  const double slowest = 12;
  Sketch sketch;
  sketch.gravity = "0 0 -9.81";
  sketch.body =
      fmt::format("    <mesh file=\"ladder-{}.obj\"/>\n    <mass density=\"1\" thickness=\"1\"/>\n"
                  "    <springs><stretch k=\"{}\"/></springs>\n    <viscosity value=\"{}\" per=\"body\"/>\n"
                  "    <fix side=\"+z\"/>\n    <fix all=\"yes\" axes=\"xy\"/>\n"
                  "    <probe name=\"end\" side=\"-z\"/>\n",
                  -exponent, in_short(ladder_k), in_short(2 * slowest * ladder.mass()));
  const bool own_step = scheme.solves || scheme.adaptive;
  sketch.time = time_of(scheme.name,
                        scheme.name == "static" ? "1"
                        : own_step              ? "0.01"
                                                : "auto",
                        scheme.name == "static" ? 1 : 3);
  CheckCase one;
  one.name = fmt::format("mass/ladder/{}/{}", scheme.name, decade(-exponent));
  const double known = ladder.extension(), error = scheme.adaptive ? 1e-5 : 1e-6 * known;
  one.expectation =
      fmt::format("light cells of {} kg between cells of 1 kg: hangs at rest, longer by {:.6g} m, to {:.1g} m",
                  in_short(ladder.heights[1]), known, error);
  one.preset = sketch.text();
  one.files = {{fmt::format("ladder-{}.obj", -exponent), ladder.obj()}};
  one.row = "ladder, " + scheme.name;
  one.column = decade(-exponent);
  one.quick = exponent == -6 && (scheme.name == "symplectic" || scheme.name == "static");
  one.run = [known, error](const Bench& bench, Finding& finding) {
    const Trial trial = bench.open();
    const long steps = std::lround(trial->duration() / trial->step_size());
    for (long n = 0; n < steps; ++n) trial->step();
    const auto reading = trial.body().probes[0].read(trial.body());
    finding.near("extension [m]", reading ? -reading->displacement.z() : NAN, known, error);
    finding.what = fmt::format("{} steps of {:.3g} s", steps, trial->step_size());
  };
  return one;
}

// No other forces act: momentum is conserved, and so is the energy not lost in the impact. A ball M times as
// heavy as the sheet keeps at least (M − 1)/(M + 1) of its speed: an elastic impact with the whole sheet.
CheckCase ball_case(int exponent) {
  const double ratio = std::pow(10.0, exponent);
  Sketch sketch;
  sketch.body =
      "    <sheet pattern=\"triangles\" cells=\"6 6\" size=\"1 1\"/>\n    <mass total=\"0.1\"/>\n"
      "    <springs><stretch k=\"1e3\" damping=\"0.1\"/></springs>\n    <contact with=\"obstacles\"/>\n";
  sketch.world = fmt::format("<sphere centre=\"0.5 0.5 0.3\" radius=\"0.2\" mass=\"{}\" velocity=\"0 0 -2\"/>",
                             in_short(0.1 * ratio));
  sketch.time = time_of("symplectic", "auto", 0.5);
  CheckCase one;
  one.name = "mass/ball on sheet/" + decade(exponent);
  one.expectation =
      fmt::format("a ball {} times as heavy as a free sheet flies into it: momentum to 1e-9, no energy that "
                  "was not there, and the ball no slower than the hardest blow leaves it",
                  in_short(ratio));
  one.preset = sketch.text();
  one.row = "ball on sheet";
  one.column = decade(exponent);
  one.quick = exponent == 6;
  one.run = [ratio](const Bench& bench, Finding& finding) {
    const Trial trial = bench.open();
    const Vec3 before = trial->momentum();
    const Course course = run(*trial.scene, std::lround(0.5 / trial->step_size()), 10);
    finding.what = course.stopped ? course.why : fmt::format("{} steps", course.steps);
    const double speed = -trial->world().spheres[0].velocity.z();
    finding.at_most("change of momentum, over it", (trial->momentum() - before).norm() / before.norm(), 1e-9);
    finding.at_most("energy over its start", course.most_energy / course.first_energy, 1 + 1e-9);
    finding.within("speed of the ball [m/s]", speed, 2 * (ratio - 1) / (ratio + 1), 2);
  };
  return one;
}

std::vector<CheckCase> mass_cases() {
  std::vector<CheckCase> all;
  for (const Scheme& scheme : all_schemes())
    for (const int exponent : {-2, -4, -6})
      if (exponent == -2 || scheme.solves ||
          scheme.limit({1, 0, 0}) > 0) // a scheme that is stable only with damping needs 1e8 steps
        all.push_back(ladder_case(scheme, exponent));
  for (const int exponent : {0, 2, 4, 6}) all.push_back(ball_case(exponent));
  return all;
}

} // namespace

CheckFamily mass_family() {
  return {"mass", "Masses that differ by a million",
          "A ladder of springs whose light cells, of 1e-2 to 1e-6 kg, carry cells of 1 kg: how long it hangs "
          "is exact. And "
          "a ball of 1 to a million times the mass of the sheet that it flies into.",
          mass_cases};
}

} // namespace rend
