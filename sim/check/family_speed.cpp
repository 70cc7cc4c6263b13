// A thousand kilometres a second.
#include "sim/check/families.h"
#include "sim/check/sketch.h"
#include "sim/check/watch.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>

namespace rend {
namespace {

constexpr double thrown_speed = 1e6;

CheckCase flight(const Matter& matter, const Scheme& scheme) {
  Sketch sketch;
  sketch.body = matter.shape + "    <mass total=\"1\"/>\n" + matter.matter(1e4, 0.3) +
                "    <drive all=\"yes\" velocity=\"1e6 0 0\" until=\"1e-9\" then=\"free\"/>\n";
  if (matter.small_strain() && matter.dimension == 2) sketch.body += "    <fix all=\"yes\" axes=\"z\"/>\n";
  sketch.time = time_of(scheme.name, "1e-4", 0.2);
  CheckCase one;
  one.name = fmt::format("speed/flight/{}/{}", matter.name, scheme.name);
  one.expectation =
      "thrown with 1e6 m/s (driven through the first nanosecond), free for 2000 steps of 0.1 ms: it is where "
      "v t says, to 1e-10 of the way, keeps its momentum to 1e-10, and its shape to what rounding such "
      "coordinates leaves (1e-6 of its size)";
  one.preset = sketch.text();
  one.row = matter.name;
  one.column = scheme.name;
  one.quick = scheme.name == "symplectic" && matter.dimension == 2;
  one.run = [](const Bench& bench, Finding& finding) {
    const Trial trial = bench.open();
    trial->step();
    const Body& body = trial.body();
    const auto mean = [&] {
      Vec3 sum = Vec3::Zero();
      double mass = 0;
      for (std::size_t i = 0; i < body.vertices(); ++i)
        if (const double inverse = body.program->inverse_mass()[i]; inverse > 0) {
          sum += body.map->position().values()[i].vec() / inverse;
          mass += 1 / inverse;
        }
      return Vec3(sum / mass);
    };
    const Vec3 start = mean(), momentum = trial->momentum();
    const double since = trial->time();
    const Course course = run(*trial.scene, 2000, 100);
    const double way = thrown_speed * (trial->time() - since);
    finding.what = course.why;
    finding.at_most("error of the way, over it", (mean() - start - Vec3(way, 0, 0)).norm() / way, 1e-10);
    finding.at_most("change of momentum, over it", (trial->momentum() - momentum).norm() / momentum.norm(),
                    1e-10);
    finding.at_most("distortion over size", distortion(body) / size_of(body), 1e-6);
  };
  return one;
}

// It may be stopped: but in words, by a state that is whole.
// Whether drives go on to put energy into it.
enum class Energy { Kept, Driven };

CheckCase crash(const std::string& name, const std::string& body, const std::string& world,
                const std::string& step, Energy energy) {
  const bool gains = energy == Energy::Driven;
  Sketch sketch;
  sketch.body = body;
  sketch.world = world;
  sketch.time = time_of("symplectic", step, 1);
  CheckCase one;
  one.name = "speed/crash/" + name;
  one.expectation =
      gains
          ? "2000 steps, or stopped as unstable with the step and the body named; all numbers finite either way"
          : "2000 steps, or stopped as unstable with the step and the body named; all numbers finite either "
            "way, and no kinetic and elastic energy that was not there";
  one.preset = sketch.text();
  one.row = name;
  one.quick = name.starts_with("floor");
  one.run = [gains](const Bench& bench, Finding& finding) {
    const Trial trial = bench.open();
    if (!gains) trial->step(); // accelerated by a drive
    const Course course = run(*trial.scene, 2000, 10);
    finding.what = course.stopped ? course.why : fmt::format("2000 steps of {:.3g} s", trial->step_size());
    finding.at_least("finite", is_finite(*trial.scene), 1);
    if (!gains) finding.at_most("energy over its start", course.most_energy / course.first_energy, 1.001);
    if (course.stopped) finding.at_least("named", course.why.find("body") != std::string::npos, 1);
  };
  return one;
}

std::vector<CheckCase> speed_cases() {
  std::vector<CheckCase> all;
  for (const Matter& matter : all_matters("2 1 1", "1 0.5 0.5", "2 2", "1 1")) {
    if (matter.model == "corotational-qr") continue; // differs from the other model only in its rotation
    for (const Scheme& scheme : all_schemes())
      if (!scheme.solves && scheme.limit({1, 0, 0}) > 0) all.push_back(flight(matter, scheme));
    all.push_back(flight(matter, *find_scheme("implicit")));
  }
  const std::string sheet =
      "    <sheet pattern=\"triangles\" cells=\"4 4\" size=\"1 1\"/>\n    <place translate=\"0 0 1000\"/>\n"
      "    <mass total=\"0.1\"/>\n    <springs><stretch k=\"60\" damping=\"0.01\"/></springs>\n";
  const std::string thrown = "    <drive all=\"yes\" velocity=\"0 0 -1e6\" until=\"1e-9\" then=\"free\"/>\n";
  all.push_back(crash("floor", sheet + thrown + "    <contact with=\"floor\" friction=\"0.5\"/>\n",
                      "<floor z=\"0\"/>", "1e-4", Energy::Kept));
  all.push_back(crash("box", sheet + thrown + "    <contact with=\"obstacles\"/>\n",
                      "<box low=\"0.3 0.3 0\" high=\"0.6 0.7 0.5\"/>", "1e-4", Energy::Kept));
  all.push_back(crash("hit by a sphere", sheet + "    <contact with=\"obstacles\"/>\n",
                      "<sphere centre=\"0.5 0.5 1300\" radius=\"0.2\" mass=\"0.01\" velocity=\"0 0 -1e6\"/>",
                      "1e-4", Energy::Kept));
  all.push_back(crash("torn apart by drives",
                      sheet + "    <fix side=\"-x\"/>\n    <drive side=\"+x\" velocity=\"1e6 0 0\"/>\n", "",
                      "1e-4", Energy::Driven));
  all.push_back(crash("spun at 1e6 degrees a second", sheet + "    <drive side=\"-x\" rotate=\"0 0 1 1e6\"/>\n",
                      "", "1e-5", Energy::Driven));
  return all;
}

} // namespace

CheckFamily speed_family() {
  return {"speed", "A thousand kilometres a second",
          "Free flight at 1e6 m/s under every scheme that has a stable step; then against floor, box and "
          "sphere, and what "
          "is pulled or spun so fast that a step passes many elements.",
          speed_cases};
}

} // namespace rend
