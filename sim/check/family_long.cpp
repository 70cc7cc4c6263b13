// A million steps without drives or damping.
#include "sim/check/families.h"
#include "sim/check/sketch.h"
#include "sim/check/watch.h"

#include <fmt/format.h>

#include <cmath>

namespace rend {
namespace {

struct Mean {
  double sum = 0;
  long count = 0;
  double value() const { return sum / static_cast<double>(count); }
};

CheckCase long_case(const Matter& matter, const Scheme& scheme, long steps) {
  Sketch sketch;
  sketch.body = matter.shape + "    <mass total=\"1\"/>\n" + matter.matter(1e4, 0.3);
  if (matter.small_strain() && matter.dimension == 2) sketch.body += "    <fix all=\"yes\" axes=\"z\"/>\n";
  sketch.time = time_of(scheme.name, scheme.solves ? "1e-3" : "auto", scheme.solves ? 1e3 : 2e3);
  CheckCase one;
  one.name = fmt::format("long/{}/{}", matter.name, scheme.name);
  const bool keeps = scheme.name == "symplectic" || scheme.name == "verlet";
  const bool turns = !matter.small_strain();
  one.expectation = fmt::format(
      "free and shaken (not in the preset file{}) with a hundredth of its speed of sound, {:g} steps of {}: "
      "the mean energy of the last tenth {}; momentum to 1e-9{}",
      matter.small_strain()
          ? ", without drift and turn, which small strain takes for a displacement and for swelling"
          : "",
      static_cast<double>(steps), scheme.solves ? "1 ms" : "half the automatic size",
      keeps ? "lies within 5 % of that of the first" : "is not above that of the first",
      turns && keeps ? ", and angular momentum to 1e-6 of m v L" : "");
  one.preset = sketch.text();
  one.row = matter.name;
  one.column = scheme.name;
  // A rotation would be unbounded growth, and far from rest displacements have larger round-off.
  const bool small = matter.small_strain();
  one.run = [=](const Bench& bench, Finding& finding) {
    Trial trial = bench.open();
    const double step = scheme.solves ? trial->step_size() : trial->step_size() / 2;
    if (!scheme.solves) trial = bench.open({{"time.step", fmt::format("{}", step)}});
    constexpr double pace = 1; // [m/s]; the speed of sound is 100
    shake(trial.body(), pace, 3);
    if (small) stop_as_a_whole(trial.body());
    const Vec3 momentum = trial->momentum(), turn = trial->angular_momentum();
    Mean first, last;
    for (long n = 0; n < steps; ++n) {
      trial->step();
      if (n % (steps / 2000) != 0) continue;
      if (n < steps / 10) first.sum += energy(*trial.scene), ++first.count;
      if (n >= steps - steps / 10) last.sum += energy(*trial.scene), ++last.count;
    }
    const double ratio = last.value() / first.value();
    if (keeps)
      finding.within("mean energy of the last tenth over that of the first", ratio, 0.95, 1.05);
    else
      finding.within("mean energy of the last tenth over that of the first", ratio, 0, 1.001);
    finding.at_most("change of momentum [kg m/s]", (trial->momentum() - momentum).norm(), 1e-9 * pace);
    const double turned = (trial->angular_momentum() - turn).norm();
    if (turns && keeps) finding.at_most("change of angular momentum [kg m2/s]", turned, 1e-6 * pace);
    finding.what = fmt::format("{} steps of {:.3g} s; the angular momentum changed by {:.2g} kg m2/s", steps,
                               step, turned);
  };
  return one;
}

std::vector<CheckCase> long_cases() {
  std::vector<CheckCase> all;
  for (const Matter& matter : all_matters("1 1 1", "1 0.8 0.9", "1 1", "1 0.8")) {
    if (matter.name.ends_with("mixed")) continue;
    for (const Scheme& scheme : all_schemes()) {
      if (matter.model == "corotational-qr" && scheme.name != "symplectic") continue; // as with the other frame
      if (!scheme.solves && !scheme.adaptive && scheme.limit({1, 0, 0}) > 0)
        all.push_back(long_case(matter, scheme, 1000000));
      if (scheme.name == "implicit" && (matter.model == "springs" || matter.model == "corotational"))
        all.push_back(long_case(matter, scheme, 20000));
    }
  }
  return all;
}

} // namespace

CheckFamily long_family() {
  return {"long", "A million steps",
          "Single elements (a box of six tetrahedra, two prisms, a hexahedron; a quad, two triangles), free, "
          "neither driven "
          "nor damped, for a million steps. Symplectic schemes must keep the energy, the others must not make "
          "any; momentum "
          "stays, and angular momentum where the model knows rotations.",
          long_cases};
}

} // namespace rend
