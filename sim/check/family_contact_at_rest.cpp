// Bodies at rest that contact holds, under explicit schemes: on the floor, on slopes, on each other.
//
// What is to stay at rest begins there, with a weight that grows in the first second.
// How long a bounce lasts that a sudden weight makes is a matter of damping, not of contact.
#include "sim/check/families.h"
#include "sim/check/sketch.h"
#include "sim/check/watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

CheckCase resting_case(const std::string& what, const std::string& how, const Sketch& sketch) {
  CheckCase one;
  one.name = fmt::format("contact-at-rest/{}/{}", what, how);
  one.preset = sketch.text();
  one.row = what;
  one.column = how;
  return one;
}

// Of 10 kg, on the floor.
Sketch block_on_floor(double young, double drag, double friction) {
  Sketch sketch;
  sketch.body = fmt::format(
      "    <bar cells=\"4 4 2\" size=\"0.4 0.4 0.2\"/>\n    <place translate=\"0 0 0.002\"/>\n"
      "    <mass total=\"10\"/>\n    <elasticity young=\"{}\" poisson=\"0\" damping-stiffness=\"0.003\"/>\n"
      "    <viscosity value=\"{}\" per=\"body\"/>\n    <contact with=\"floor\" friction=\"{}\"/>\n",
      in_short(young), in_short(drag), in_short(friction));
  sketch.gravity = std::string("0 0 -9.81");
  sketch.world = "<floor z=\"0\"/>";
  return sketch;
}

double static_energy(const Bench& bench) { // [J], U
  const Trial trial = bench.open({{"time.integrator", "static"}, {"time.step", "1"}, {"time.duration", "1"}});
  trial->step();
  return trial->elastic_energy();
}

// Explicit Euler takes its step from the drag, and would take a minute over a stiff one.
CheckCase lies_case(const Scheme& scheme) {
  const bool needs_drag = scheme.limit({1, 0.1, 0}) <= 0;
  Sketch sketch = block_on_floor(needs_drag ? 1e4 : 1e5, needs_drag ? 50 : 0, 0.5);
  sketch.time = time_of(scheme.name, "auto", 20);
  CheckCase one = resting_case("block that lies", scheme.name, sketch);
  one.expectation =
      "a damped block is set down on the floor: after 20 s U is that of the static solution, to 10 %";
  one.quick = !needs_drag;
  one.run = [](const Bench& bench, Finding& finding) {
    constexpr int last = 100; // steps
    const double known = static_energy(bench);
    const Trial trial = bench.open();
    go_to(*trial.scene, trial->duration() - last * trial->step_size());
    double sum = 0, least = 1e300, most = 0;
    for (int n = 0; n < last; ++n) {
      trial->step();
      const double share = trial->elastic_energy() / known;
      sum += share;
      least = std::min(least, share);
      most = std::max(most, share);
    }
    finding.near("mean U of the last 100 steps over the static one", sum / last, 1, 0.1);
    finding.within("least of these", least, 0.9, 1.1);
    finding.within("largest of these", most, 0.9, 1.1);
    finding.what = fmt::format("{:.3f}, from {:.3f} to {:.3f}; {:.2g} m/s", sum / last, least, most,
                               rms_speed(*trial.scene));
  };
  return one;
}

// Gravity is turned by an angle whose tangent is 0.4951, and grows in the first second.
CheckCase slope_case(const Scheme& scheme, bool stands) {
  constexpr double degrees = 26.34, mass = 10, g = 9.81;
  const double angle = degrees * M_PI / 180, friction = stands ? 0.5 : 0.49;
  Sketch sketch = block_on_floor(1e5, 0, friction);
  sketch.gravity =
      fmt::format("{} 0 {}\" over=\"1", in_short(g * std::sin(angle)), in_short(-g * std::cos(angle)));
  sketch.time = time_of(scheme.name, "auto", 5);
  const double known = g * (std::sin(angle) - friction * std::cos(angle));
  CheckCase one = resting_case(stands ? "slope: stands" : "slope: slides", scheme.name, sketch);
  one.expectation =
      fmt::format("a block on a slope of {} degrees, whose weight grows in the first second, with a "
                  "friction of {}: ",
                  in_short(degrees), in_short(friction));
  one.expectation += stands ? "it creeps by 1e-4 m in the next 4 s at most"
                            : fmt::format("in the next 3 s it slides with {:.4f} m/s2, to 5 %", known);
  one.quick = true;
  one.run = [known, stands](const Bench& bench, Finding& finding) {
    const Trial trial = bench.open();
    go_to(*trial.scene, 1);
    const double place = mean_way(trial.body()).x(), speed = trial->momentum().x() / mass;
    go_to(*trial.scene, stands ? 5 : 4);
    if (stands)
      finding.at_most("way in 4 s [m]", std::abs(mean_way(trial.body()).x() - place), 1e-4);
    else
      finding.near("acceleration [m/s2]", (trial->momentum().x() / mass - speed) / 3, known, 0.05 * known);
  };
  return one;
}

// A damped body of a scene that is to stand.
std::string standing(const std::string& shape, double mass, double young, double damping, double friction) {
  return fmt::format("{}    <mass total=\"{}\"/>\n"
                     "    <elasticity young=\"{}\" poisson=\"0\" damping-stiffness=\"{}\"/>\n"
                     "    <contact with=\"obstacles fragments\" friction=\"{}\"/>\n",
                     shape, in_short(mass), in_short(young), in_short(damping), in_short(friction));
}

CheckCase standing_case(const std::string& what, const Scheme& scheme, const std::vector<std::string>& bodies) {
  Sketch sketch;
  sketch.body = bodies[0];
  for (std::size_t n = 1; n < bodies.size(); ++n)
    sketch.others += fmt::format("  <body name=\"body-{}\">\n{}  </body>\n", n, bodies[n]);
  sketch.gravity = std::string("0 0 -9.81") + "\" over=\"1";
  sketch.world = "<floor z=\"0\"/>";
  sketch.time = time_of(scheme.name, "auto", 5.5);
  CheckCase one = resting_case(what, scheme.name, sketch);
  one.run = [](const Bench& bench, Finding& finding) {
    const Trial trial = bench.open();
    go_to(*trial.scene, 5);
    double fastest = 0;
    while (trial->time() < trial->duration() - 1e-9) {
      trial->step();
      fastest = std::max(fastest, rms_speed(*trial.scene));
    }
    finding.at_most("largest rms speed after 5 s [m/s]", fastest, 1e-3);
    double furthest = 0;
    for (std::size_t n = 0; n < trial->bodies().size(); ++n)
      furthest = std::max(furthest, mean_way(trial.body(n)).norm());
    finding.at_most("furthest way of a body [m]", furthest, 0.05);
  };
  return one;
}

std::string cube(double side, double z) {
  return fmt::format("    <bar cells=\"1 1 1\" size=\"{0} {0} {0}\"/>\n    <place translate=\"0 0 {1}\"/>\n",
                     in_short(side), in_short(z));
}

CheckCase stack_case(const Scheme& scheme) {
  std::vector<std::string> bodies;
  for (int n = 0; n < 10; ++n) bodies.push_back(standing(cube(0.2, 0.002 + 0.202 * n), 1, 1e5, 0.005, 0.5));
  CheckCase one = standing_case("stack of ten", scheme, bodies);
  one.expectation =
      "ten blocks on each other, whose weight grows in the first second: they stand, and after 5 s "
      "move by 1 mm/s at most";
  one.quick = scheme.name == "symplectic" || scheme.name == "verlet";
  return one;
}

// The light one is compressed by 2.5 %. The heavy one damps what it bounces on.
CheckCase heavy_case(const Scheme& scheme) {
  CheckCase one = standing_case(
      "heavy on light", scheme,
      {standing(cube(0.2, 0.002), 1e-3, 1e5, 1e-4, 0.5), standing(cube(0.2, 0.204), 10, 1e5, 0.005, 0.5)});
  one.expectation =
      "a block of 10 kg on one of 1 g, whose weight grows in the first second: they stand, and after "
      "5 s move by 1 mm/s at most";
  return one;
}

// Thin boxes: one leans to the right, another against its lower side, a third against the upper side of that.
std::vector<std::string> three_cards() {
  using Point = Eigen::Vector2d;              // x, z [m]
  constexpr double thick = 0.04, gap = 0.002; // [m]
  const auto card = [&](double length, double width, double turn, const Point& corner) {
    return standing(fmt::format("    <bar cells=\"{} 2 1\" size=\"{} {} {}\"/>\n"
                                "    <place rotate=\"0 {} 0\" translate=\"{} {} {}\"/>\n",
                                std::lround(10 * length), in_short(length), in_short(width), in_short(thick),
                                in_short(turn), in_short(corner.x()), in_short(-width / 2),
                                in_short(corner.y())),
                    0.4 * length, 2e5, 0.001, 0.8);
  };
  // The corner of a card that leans to the left, and touches a face.
  const auto leaning = [&](double length, double steep, const Point& on, const Point& normal) {
    const double c = std::cos(steep), s = std::sin(steep);
    const Point foot(0, gap + thick * c), end = foot + Point(-length * c - thick * s, length * s - thick * c);
    return Point(foot + Point((gap - normal.dot(end - on)) / normal.x(), 0));
  };
  const double degree = M_PI / 180, c = std::cos(70 * degree), s = std::sin(70 * degree);
  const Point first(0, gap), second = leaning(0.42, 70 * degree, first, {s, -c}),
                             third = leaning(0.3, 60 * degree, second, {s, c});
  return {card(0.5, 0.3, -70, first), card(0.42, 0.24, 70 - 180, second), card(0.3, 0.18, 60 - 180, third)};
}

CheckCase cards_case(const Scheme& scheme) {
  CheckCase one = standing_case("three cards", scheme, three_cards());
  one.expectation =
      "three cards lean on each other, and their weight grows in the first second: they stand, and after "
      "5 s move by 1 mm/s at most";
  return one;
}

std::vector<CheckCase> resting_cases() {
  std::vector<CheckCase> all;
  for (const Scheme& scheme : explicit_schemes(true)) all.push_back(lies_case(scheme));
  for (const Scheme& scheme : explicit_schemes(false)) {
    for (const bool stands : {true, false}) all.push_back(slope_case(scheme, stands));
    all.push_back(stack_case(scheme));
    all.push_back(cards_case(scheme));
    all.push_back(heavy_case(scheme));
  }
  return all;
}

} // namespace

CheckFamily contact_at_rest_family() {
  return {
      "contact-at-rest", "What contact holds at rest",
      "Bodies on the floor, on slopes and on each other, under explicit schemes: they stay, slide as Coulomb "
      "says, and are compressed as the static solution says.",
      resting_cases};
}

} // namespace rend
