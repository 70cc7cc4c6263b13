// Contact that makes no energy: what is set down, collides and lies on the floor, under explicit schemes.
#include "sim/check/families.h"
#include "sim/check/sketch.h"
#include "sim/check/watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace rend {
namespace {

CheckCase contact_case(const std::string& what, const std::string& how, const Sketch& sketch) {
  CheckCase one;
  one.name = fmt::format("contact/{}/{}", what, how);
  one.preset = sketch.text();
  one.row = what;
  one.column = how;
  return one;
}

// A ball of 5 kg is set down on a block of 1 kg: it sinks in to twice its static depth, which is all the energy
// there is. Contact that shifted vertices for nothing made 29 J of it.
CheckCase ball_case(const Scheme& scheme, const std::string& step) {
  Sketch sketch;
  sketch.body = "    <bar cells=\"4 4 2\" size=\"0.4 0.4 0.2\"/>\n    <mass total=\"1\"/>\n"
                "    <elasticity young=\"1e5\" poisson=\"0\"/>\n"
                "    <contact with=\"obstacles\" thickness=\"0\"/>\n";
  sketch.gravity = "0 0 -9.81";
  sketch.world = "<floor z=\"0\"/><sphere centre=\"0.2 0.2 0.3\" radius=\"0.1\" mass=\"5\"/>";
  sketch.time = time_of(scheme.name, step, 2);
  CheckCase one = contact_case("ball", step == "auto" ? scheme.name : scheme.name + " " + step, sketch);
  one.expectation =
      "a ball of 5 kg is set down on a block of 1 kg: by theory K + U comes to 0.69 J, and at no step "
      "of 2 s to more than 0.8 J";
  one.quick = true;
  one.run = [](const Bench& bench, Finding& finding) {
    const Trial trial = bench.open();
    double most = 0;
    while (trial->time() < trial->duration() - 1e-9) {
      trial->step();
      most = std::max(most, trial->kinetic_energy() + trial->elastic_energy());
    }
    trial->check_account();
    finding.within("largest K + U [J]", most, 0.5, 0.8);
  };
  return one;
}

CheckCase rods_case(const Scheme& scheme, int cells, double least) {
  const auto rod = [&](double from, double speed) {
    return fmt::format("    <bar cells=\"{} 3 3\" size=\"1 0.1 0.1\"/>\n"
                       "    <place translate=\"{} 0 0\" velocity=\"{} 0 0\"/>\n    <mass total=\"10\"/>\n"
                       "    <elasticity young=\"1e6\" poisson=\"0\"/>\n"
                       "    <contact with=\"fragments\" friction=\"0\"/>\n",
                       cells, in_short(from), in_short(speed));
  };
  Sketch sketch;
  sketch.body = rod(-1.005, 0.5);
  sketch.others = "  <body name=\"other\">\n" + rod(0.005, -0.5) + "  </body>\n";
  sketch.time = time_of(scheme.name, "auto", 0.2);
  CheckCase one = contact_case(fmt::format("rods of {} cells", cells), scheme.name, sketch);
  one.expectation =
      fmt::format("two equal elastic rods meet at 0.5 m/s each: a wave runs through both and back, and "
                  "they part at 0.5 m/s by theory, at {} at least",
                  in_short(least));
  one.quick = cells == 20;
  one.run = [least](const Bench& bench, Finding& finding) {
    const Trial trial = bench.open();
    go_to(*trial.scene, trial->duration());
    const double left = -mean_velocity(trial.body(0)).x(), right = mean_velocity(trial.body(1)).x();
    finding.within("speed of the first [m/s]", left, least, 0.5 + 1e-9);
    finding.near("sum of velocities [m/s]", right - left, 0, 1e-9);
    finding.what = fmt::format("{:.4g} m/s, {:.4g} J kinetic of 2.5 J", left, trial->kinetic_energy());
  };
  return one;
}

// Steele, Lea and Flood's generator (2014): the same cloths everywhere.
class Dice {
public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}
  double between(double low, double high) {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    z ^= z >> 31;
    return low + (high - low) * (static_cast<double>(z >> 11) / 9007199254740992.0);
  }
  double decades(double low, double high) { return std::pow(10.0, between(low, high)); }
  template <std::size_t N> const char* one_of(const std::array<const char*, N>& words) {
    return words[static_cast<std::size_t>(between(0, N))];
  }

private:
  std::uint64_t state_;
};

Sketch random_cloth(std::uint64_t seed) {
  Dice dice(seed);
  const int cells = static_cast<int>(dice.between(2, 8));
  const double k = dice.decades(1, 3), thickness = static_cast<int>(dice.between(0, 4)) * 0.001;
  const double above = std::max(0.0, dice.between(-0.01, 0.01)), speed = std::max(0.0, dice.between(-1, 1));
  const char* pattern = dice.one_of(std::array{"quads", "triangles", "mixed", "crossed"});
  Sketch sketch;
  sketch.body =
      fmt::format("    <sheet pattern=\"{}\" cells=\"{} {}\" size=\"{:.3f} {:.3f}\"/>\n"
                  "    <place rotate=\"0 0 {:.1f}\" translate=\"0 0 {:.4f}\" velocity=\"{:.2f} 0 0\"/>\n"
                  "    <mass total=\"{:.3f}\"/>\n",
                  pattern, cells, cells, dice.between(0.2, 1), dice.between(0.2, 1), dice.between(0, 360),
                  thickness + above, speed, dice.decades(-1, 1));
  sketch.body += fmt::format("    <springs><stretch k=\"{:.1f}\" damping=\"{}\"/><shear k=\"{:.1f}\"/>"
                             "<bend kind=\"{}\" k=\"{:.3f}\"/></springs>\n",
                             k, dice.one_of(std::array{"0", "0.02"}), k * dice.between(0.1, 1),
                             dice.one_of(std::array{"provot", "angular"}), k * dice.decades(-4, -1));
  sketch.body += fmt::format("    <contact with=\"{}\" thickness=\"{:.3f}\" friction=\"{}\"/>\n",
                             dice.one_of(std::array{"floor", "obstacles self"}), thickness,
                             dice.one_of(std::array{"0", "0.3", "0.8"}));
  sketch.gravity = "0 0 -9.81";
  sketch.world = "<floor z=\"0\"/>";
  return sketch;
}

CheckCase cloth_case(const Scheme& scheme, int seed) {
  Sketch sketch = random_cloth(static_cast<std::uint64_t>(seed));
  sketch.time = time_of(scheme.name, "auto", 0.5);
  CheckCase one = contact_case(fmt::format("cloth {:02}", seed), scheme.name, sketch);
  one.expectation = "a cloth lies on the floor or a little above it, some slide: the run is not stopped";
  one.quick = seed <= 4;
  one.run = [](const Bench& bench, Finding& finding) {
    const Trial trial = bench.open();
    const long steps = std::lround(trial->duration() / trial->step_size());
    const Course course = run(*trial.scene, steps, steps);
    finding.what = course.why;
    finding.at_most("stopped as unstable", course.stopped, 0);
    finding.at_least("finite", is_finite(*trial.scene), 1);
    finding.at_most("energy gained without a cause, of all there was", trial->energy().gained_share(), 1e-3);
  };
  return one;
}

std::vector<CheckCase> contact_cases() {
  std::vector<CheckCase> all;
  for (const Scheme& scheme : explicit_schemes()) {
    all.push_back(ball_case(scheme, "auto"));
    if (scheme.adaptive) all.push_back(ball_case(scheme, "0.01"));
    all.push_back(rods_case(scheme, 20, 0.475));
    all.push_back(rods_case(scheme, 40, 0.485));
    if (scheme.adaptive) continue; // what touches goes by verlet, as there
    for (int seed = 1; seed <= 32; ++seed) all.push_back(cloth_case(scheme, seed));
  }
  return all;
}

} // namespace

CheckFamily contact_family() {
  return {
      "contact", "Contact that makes no energy",
      "What is set down, collides and lies on the floor, under explicit schemes: against what energy, momentum "
      "and waves allow.",
      contact_cases};
}

} // namespace rend
