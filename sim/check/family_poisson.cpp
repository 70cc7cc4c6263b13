// Nearly incompressible: the stress of a patch under a uniform strain, and a free body with random velocities,
// for all ν.
#include "sim/check/families.h"
#include "sim/check/sketch.h"
#include "sim/check/watch.h"

#include <fmt/format.h>

#include <cmath>

namespace rend {
namespace {

constexpr double poisson_young = 1e6;

// Every vertex on the boundary moves by u = G X; the inner ones are free.
std::string patch_body(const Matter& matter, double poisson) {
  std::string body = matter.shape + "    <mass total=\"1\"/>\n" + matter.matter(poisson_young, poisson);
  const char* gradient = matter.dimension == 3 ? "1e-3 5e-4 5e-4  5e-4 1e-3 5e-4  5e-4 5e-4 1e-3"
                                               : "1e-3 5e-4 0  5e-4 1e-3 0  0 0 0";
  const std::vector<const char*> sides = matter.dimension == 3
                                             ? std::vector<const char*>{"-x", "+x", "-y", "+y", "-z", "+z"}
                                             : std::vector<const char*>{"-x", "+x", "-y", "+y"};
  for (const char* side : sides)
    body += fmt::format("    <drive side=\"{}\" gradient=\"{}\"/>\n", side, gradient);
  if (matter.dimension == 2) body += "    <fix all=\"yes\" axes=\"z\"/>\n";
  return body + "    <probe name=\"all\" all=\"yes\"/>\n";
}

CheckCase patch(const Matter& matter, double poisson) {
  Sketch sketch;
  sketch.body = patch_body(matter, poisson);
  sketch.time = time_of("static", "1", 1);
  const double mu = poisson_young / (2 * (1 + poisson));
  const double sum =
      matter.dimension == 3 ? poisson_young / (1 - 2 * poisson) : poisson_young / (1 - poisson); // σxx/1e-3
  CheckCase one;
  one.name = fmt::format("poisson/patch/{}/{}", matter.name, poisson);
  const bool turns = matter.model == "corotational-qr";
  one.expectation =
      fmt::format("a uniform strain of 1e-3 gives {:.6g} Pa along and {:.6g} Pa of shear, to {}", sum * 1e-3,
                  mu * 1e-3, turns ? "2e-3: the frame of Gram and Schmidt takes shear for a rotation" : "1e-9");
  one.preset = sketch.text();
  one.row = matter.name;
  one.column = fmt::format("static, {}", poisson);
  one.quick = poisson == 0.4999;
  one.run = [sum, mu, error = sum * (turns ? 2e-6 : 1e-12)](const Bench& bench, Finding& finding) {
    const Trial trial = bench.open();
    trial->step();
    const auto reading = trial.body().probes[0].read(trial.body());
    const Eigen::Matrix3d stress =
        reading && reading->stress ? *reading->stress : Eigen::Matrix3d::Constant(NAN);
    finding.near("stress along x [Pa]", stress(0, 0), sum * 1e-3, error);
    finding.near("shear stress [Pa]", stress(0, 1), mu * 1e-3, error);
  };
  return one;
}

CheckCase shaken(const Matter& matter, double poisson) {
  Sketch sketch;
  sketch.body = matter.shape + "    <mass total=\"1\"/>\n" + matter.matter(poisson_young, poisson);
  if (matter.small_strain() && matter.dimension == 2) sketch.body += "    <fix all=\"yes\" axes=\"z\"/>\n";
  sketch.time = time_of("symplectic", "auto", 1);
  CheckCase one;
  one.name = fmt::format("poisson/shaken/{}/{}", matter.name, poisson);
  one.expectation =
      "free, each vertex pushed at random (not in the preset file), 3000 steps of the automatic size: the "
      "energy "
      "stays below (1 + 0.9)/(1 - 0.9) = 19 times its start, as symplectic Euler has it at 0.9 of 2/omega, "
      "and the momentum is kept";
  one.preset = sketch.text();
  one.row = matter.name;
  one.column = fmt::format("shaken, {}", poisson);
  one.quick = poisson == 0.4999 && matter.model == "corotational";
  one.run = [](const Bench& bench, Finding& finding) {
    const Trial trial = bench.open();
    shake(trial.body(), 1e-3, 7);
    const Vec3 before = trial->momentum();
    const Course course = run(*trial.scene, 3000, 20);
    finding.at_most("energy over its start", course.stopped ? NAN : course.most_energy / course.first_energy,
                    19);
    finding.at_most("change of momentum [kg m/s]", (trial->momentum() - before).norm(), 1e-3 * 1e-9);
    finding.what = course.why;
  };
  return one;
}

std::vector<CheckCase> poisson_cases() {
  std::vector<CheckCase> all;
  for (const Matter& matter : all_matters("3 3 3", "1 0.8 0.9", "3 3", "1 0.8")) {
    if (matter.model == "springs") continue; // independent of ν
    for (const double poisson : {0.0, 0.3, 0.49, 0.4999}) all.push_back(patch(matter, poisson));
    for (const double poisson : {0.49, 0.4999}) all.push_back(shaken(matter, poisson));
  }
  return all;
}

} // namespace

CheckFamily poisson_family() {
  return {"poisson", "Nearly incompressible",
          "Poisson's ratio up to 0.4999, of every model on every kind of element. A patch whose outside is "
          "moved by a "
          "uniform strain has the stress that Hooke's law says in every element (the shear modulus against a "
          "bulk modulus "
          "5000 times as large); a free body that is shaken keeps its energy bounded and its momentum.",
          poisson_cases};
}

} // namespace rend
