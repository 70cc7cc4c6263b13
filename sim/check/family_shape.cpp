// Bodies in extreme shapes: flattened to a plane, a line, a point; inverted; scrambled.
#include "sim/check/families.h"
#include "sim/check/sketch.h"
#include "sim/check/watch.h"
#include "sim/solve/spectrum.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

constexpr int seeds = 100;
constexpr long shape_steps = 6000, scrambled_steps = 3000;

const std::vector<std::string> shapes{"plane", "line", "point", "inside out", "scrambled"};

// The position of a vertex; `seed` for scrambled ones, uniform in the unit cube.
std::function<Vec3(const Vec3&, std::size_t)> placed(const std::string& shape, const Body& body,
                                                     std::uint64_t seed) {
  if (shape == "plane") return [](const Vec3& x, std::size_t) { return Vec3(x.x(), 0, x.z()); };
  if (shape == "line") return [](const Vec3& x, std::size_t) { return Vec3(x.x(), 0, 0); };
  if (shape == "point") return [](const Vec3&, std::size_t) { return Vec3(0.4, 0.4, 0); };
  if (shape == "inside out") return [](const Vec3& x, std::size_t) { return Vec3(-x.x(), x.y(), x.z()); };
  const std::vector<std::uint8_t> free(body.vertices(), 0);
  return [at = scattered(body.vertices(), body.program->inverse_mass(), free, seed)](
             const Vec3&, std::size_t slot) { return Vec3(0.5 * at[slot].vec()); };
}

struct Tally {
  int recovered = 0, all = 0;
  // the largest energy during the run, relative to that of the start or of the body as a point
  double growth = 0;
  double unrest = 0; // kinetic energy of bodies that did not recover, relative to the elastic energy of a point
  bool finite = true;
  std::string stopped;
};

// A sheet without bending stiffness is in equilibrium in any fold; a linear model in any inflated state.
bool at_rest(const Trial& trial, const Matter& matter, double scale) {
  const Body& body = trial.body();
  if (matter.small_strain() || (matter.dimension == 2 && matter.model != "springs"))
    return trial->elastic_energy() <= 1e-6 * scale;
  return distortion(body) <= 1e-3 * size_of(body);
}

void try_once(const Bench& bench, const Matter& matter, const std::string& shape, std::uint64_t seed,
              Tally& tally) {
  const Trial trial = bench.open();
  Body& body = trial.body();
  put(body, placed("point", body, seed));
  const double scale = trial->elastic_energy();
  put(body, placed(shape, body, seed));
  const Course course = run(*trial.scene, shape == "scrambled" ? scrambled_steps : shape_steps, 25);
  tally.finite = tally.finite && is_finite(*trial.scene);
  tally.growth = std::max(tally.growth, course.most_energy / std::max(course.first_energy, scale));
  if (course.stopped) tally.stopped = course.why;
  const bool back = !course.stopped && at_rest(trial, matter, scale);
  if (!back) tally.unrest = std::max(tally.unrest, trial->kinetic_energy() / scale);
  tally.recovered += back;
  ++tally.all;
}

// Why a shape is known not to recover; empty: it must.
std::string reason(const Matter& matter, const std::string& shape) {
  if (matter.model == "springs")
    return "Springs know lengths alone: what is mirrored or folded has all its lengths, flat they push nowhere "
           "out of "
           "their plane, and without length a spring has no direction. So a flattened body stays flat, and a "
           "tangled one "
           "stays in the nearest tangle; and since its force turns around at once where its length passes 0, "
           "no step follows that, "
           "and some energy may appear (less than ten times that of a point). Elements (corotational) recover "
           "from all but tangles.";
  if (matter.model == "corotational-qr")
    return "The frame of Gram and Schmidt depends on the order of the corners, and jumps where the first edge "
           "or face of a frame has no size: a body that is inside out or tangled may gain energy there, or be "
           "stopped as unstable. rotation=\"polar\", the default, gains none.";
  if (shape == "scrambled" || shape == "point" ||
      (matter.dimension == 2 && shape != "inside out" && !matter.small_strain()))
    return "A tangle may be an equilibrium of its own: elements that are inside out hold each other so, at an "
           "energy that "
           "is the same whatever the start. The body rests there; nothing but a push from outside untangles "
           "it.";
  return {};
}

CheckCase shape_case(const Matter& matter, const std::string& shape) {
  Sketch sketch;
  sketch.body = matter.shape + "    <mass total=\"1\"/>\n" + matter.matter(1e4, 0.3) +
                "    <viscosity value=\"60\" per=\"body\"/>\n";
  if (matter.small_strain() && matter.dimension == 2) sketch.body += "    <fix all=\"yes\" axes=\"z\"/>\n";
  sketch.time = time_of("symplectic", "auto", 1e3);
  CheckCase one;
  one.name = fmt::format("shape/{}/{}", matter.name, shape);
  const std::string what =
      shape == "scrambled" ? fmt::format("{} times, each with other random places", seeds) : "set so";
  const char* rest = matter.small_strain()
                         ? "a shape without strain energy (a model of small strain takes turns for "
                           "swelling, so the shape itself may differ)"
                     : matter.dimension == 2 && matter.model != "springs"
                         ? "a shape without strain energy (without bending it may stay folded)"
                         : "its shape (within 1e-3 of its size, wherever it is and however turned)";
  one.expectation = fmt::format(
      "{} (not in the preset file, {}): no energy appears beyond that of the start, or of the body as a "
      "point, and the body comes back to {}",
      shape, what, rest);
  one.preset = sketch.text();
  one.row = matter.name;
  one.column = shape;
  one.quick = matter.model == "corotational" && shape == "inside out";
  one.run = [matter, shape](const Bench& bench, Finding& finding) {
    Tally tally;
    const int times = shape == "scrambled" ? seeds : 1;
    for (int n = 0; n < times; ++n) try_once(bench, matter, shape, 100 + static_cast<std::uint64_t>(n), tally);
    finding.what =
        tally.stopped.empty() ? fmt::format("{} of {} came back", tally.recovered, tally.all) : tally.stopped;
    finding.at_least("finite", tally.finite, 1);
    const std::string known = reason(matter, shape);
    const bool turns = matter.model == "corotational-qr", springs = matter.model == "springs";
    finding.at_most("most energy over that of the start or of a point", tally.growth,
                    turns     ? HUGE_VAL
                    : springs ? 10
                              : 1.05);
    if (known.empty() || (tally.recovered == tally.all && tally.growth <= 1.05)) {
      finding.at_least("came back", tally.recovered, times);
      return;
    }
    finding.limit(finding.what, known);
    if (!turns && !springs)
      finding.at_most("kinetic energy of the others over the elastic one of a point", tally.unrest, 1e-2);
  };
  return one;
}

std::vector<CheckCase> shape_cases() {
  std::vector<CheckCase> all;
  for (const Matter& matter : all_matters("2 2 2", "1 0.8 0.9", "3 3", "1 0.8"))
    for (const std::string& shape : shapes) all.push_back(shape_case(matter, shape));
  return all;
}

} // namespace

CheckFamily shape_family() {
  return {"shape", "Flattened, inside out, scrambled",
          "A free, damped body of every model and element is put where no material would be: onto a plane, a "
          "line, a point; "
          "mirrored; with all vertices at random (100 times). With the automatic step it must gain no energy "
          "and find "
          "its shape again.",
          shape_cases};
}

} // namespace rend
