// Tearing under strain: every criterion with every change that fits, on bodies that are stiff, tiny, huge,
// pulled fast, scrambled or bent out of plane.
#include "sim/check/families.h"
#include "sim/check/sketch.h"
#include "sim/check/watch.h"
#include "sim/solve/spectrum.h"
#include "sim/topology/validate.h"

#include <fmt/format.h>

#include <cmath>

namespace rend {
namespace {

constexpr long least_steps = 400;

// A body of 1 m, a stiffness of 1e4 Pa (or N/m for 1 m), and factors of these.
struct Strain {
  std::string name;
  double length = 1, stiffness = 1;
  double speed = 1;       // of the pull, relative to the speed that reaches a strain of 1 by the end of the run
  bool scrambled = false; // every vertex moved by up to half a cell
  bool out_of_plane = false;
};

const std::vector<Strain>& strains() {
  static const std::vector<Strain> all{{.name = "plain"},
                                       {.name = "stiff: 1e12 Pa", .stiffness = 1e8},
                                       {.name = "1 micrometre", .length = 1e-6},
                                       {.name = "1000 km", .length = 1e6},
                                       {.name = "pulled 100 times as fast", .speed = 100},
                                       {.name = "scrambled", .scrambled = true},
                                       {.name = "out of plane", .out_of_plane = true}};
  return all;
}

struct ForceLaw {
  std::string criterion, kind, change; // change: empty: the default of the cell
  double threshold;                    // in units of E (stress), E L² (force), 1 (strain)
};

const std::vector<ForceLaw>& spring_laws() {
  static const std::vector<ForceLaw> all{{"atomic-spring", "stretch", "delete-edge", 0.03},
                                         {"atomic-spring", "stretch", "split-vertex", 0.03},
                                         {"atomic-spring", "shear", "delete-element", 0.03},
                                         {"strain", "stretch", "delete-edge", 0.2},
                                         {"atomic-vertex", "", "split-vertex", 0.03},
                                         {"cumulative-vertex", "", "split-vertex", 0.001},
                                         {"atomic-border", "", "separate", 0.02},
                                         {"global-border", "", "separate", 0.004}};
  return all;
}
const std::vector<ForceLaw>& element_laws() {
  static const std::vector<ForceLaw> all{
      {"atomic-element", "", "delete-element", 0.2},    {"strain", "", "delete-element", 0.2},
      {"vertex-stress", "", "split-vertex", 0.2},       {"atomic-vertex", "", "split-vertex", 0.002},
      {"cumulative-vertex", "", "split-vertex", 0.002}, {"atomic-border", "", "separate", 0.002},
      {"global-border", "", "separate", 0.002}};
  return all;
}

struct Pulled {
  enum class Of { Springs, Elements };
  std::string name, pattern;
  Of of;
  int dimension;
};
const std::vector<Pulled>& pulled_bodies() {
  static const std::vector<Pulled> all{{"sheet of springs", "quads", Pulled::Of::Springs, 2},
                                       {"sheet of elements", "triangles", Pulled::Of::Elements, 2},
                                       {"solid of springs", "hexahedra", Pulled::Of::Springs, 3},
                                       {"solid of elements", "tetrahedra", Pulled::Of::Elements, 3}};
  return all;
}

// The unit of time is that of a sound wave along 1 m: T = L √(ρ/E), ρ = 1000 kg/m³.
std::string preset_of(const Pulled& body, const ForceLaw& law, const Strain& strain) {
  const double L = strain.length, E = 1e4 * strain.stiffness, T = L * std::sqrt(1000 / E);
  const std::string l = in_short(L);
  Sketch sketch;
  const bool force =
      law.criterion != "strain" && law.criterion != "vertex-stress" && law.criterion != "atomic-element";
  const double unit = law.criterion == "strain" ? 1 : force ? E * L * L : E;
  if (body.dimension == 2)
    sketch.body = fmt::format("    <sheet pattern=\"{}\" cells=\"5 5\" size=\"{} {}\"/>\n", body.pattern, l, l);
  else
    sketch.body = fmt::format("    <bar pattern=\"{}\" cells=\"4 2 2\" size=\"{} {} {}\"/>\n", body.pattern, l,
                              in_short(0.5 * L), in_short(0.5 * L));
  sketch.body +=
      fmt::format("    <mass total=\"{}\"/>\n", in_short((body.dimension == 2 ? 100 : 250) * L * L * L));
  const std::string k = in_short(E * L / 10);
  if (body.of == Pulled::Of::Springs)
    sketch.body += fmt::format("    <springs><stretch k=\"{0}\"/><shear k=\"{0}\"/></springs>\n", k);
  else
    sketch.body +=
        fmt::format("    <elasticity model=\"corotational\" young=\"{}\" poisson=\"0.3\"{}/>\n", in_short(E),
                    body.dimension == 2 ? fmt::format(" thickness=\"{}\"", in_short(0.1 * L)) : "");
  sketch.body += fmt::format("    <viscosity value=\"{}\" per=\"body\"/>\n",
                             in_short((body.dimension == 2 ? 100 : 250) * L * L * L * 2 / T));
  const double pull = strain.speed * L / (8 * T);
  sketch.body += "    <fix side=\"-x\"/>\n";
  sketch.body += fmt::format("    <drive side=\"+x\" velocity=\"{} 0 {}\"/>\n", in_short(pull),
                             in_short(strain.out_of_plane ? pull : 0));
  sketch.body += fmt::format("    <tear criterion=\"{}\"{} change=\"{}\" threshold=\"{}\"/>\n", law.criterion,
                             law.kind.empty() ? "" : fmt::format(" kind=\"{}\"", law.kind), law.change,
                             in_short(law.threshold * unit));
  sketch.time = time_of("symplectic", "auto", 8 * T / strain.speed);
  return sketch.text();
}

// By up to half a cell, in every direction that is not constrained.
void scramble(Body& body, double reach) {
  std::vector<std::uint8_t> held(body.vertices(), 0);
  body.constraints.mark(0, held.data());
  const Records push = scattered(body.vertices(), body.program->inverse_mass(), held, 17);
  put(body, [&](const Vec3& rest, std::size_t slot) { return Vec3(rest + reach * push[slot].vec()); });
}

CheckCase tear_case(const Pulled& body, const ForceLaw& law, const Strain& strain) {
  CheckCase one;
  const std::string what = law.criterion + (law.kind.empty() ? "" : "(" + law.kind + ")") + ", " + law.change;
  one.name = fmt::format("tear/{}/{}/{}", body.name, what, strain.name);
  const bool deletes = law.change == "delete-element" || law.change == "delete-edge";
  one.expectation = fmt::format(
      "pulled by its ends{} until it tears: the map obeys its axioms, all numbers are finite, the mass "
      "is {}, and what flies off is no faster than 10 times sound and pull",
      strain.scrambled ? " and scrambled by half a cell (not in the preset file)" : "",
      deletes ? "not more" : "the same");
  one.preset = preset_of(body, law, strain);
  one.row = body.name + ": " + what;
  one.column = strain.name;
  one.quick = law.change == "split-vertex" && strain.name == "scrambled";
  const double sound = std::sqrt(1e4 * strain.stiffness / 1000);
  one.run = [=](const Bench& bench, Finding& finding) {
    const Trial trial = bench.open();
    Body& it = trial.body();
    if (strain.scrambled) scramble(it, 0.1 * strain.length);
    const double mass = trial->mass();
    const long all = std::max(least_steps, std::lround(trial->duration() / trial->step_size()));
    const Course course = run(*trial.scene, all, all);
    finding.what = course.stopped ? course.why : fmt::format("{} tears in {} steps", trial->tears(), all);
    finding.at_most("stopped as unstable", course.stopped, 0);
    finding.at_least("tears", static_cast<double>(trial->tears()), 1);
    finding.at_least("finite", is_finite(*trial.scene), 1);
    const auto broken = validate(it.map->map());
    finding.at_most(broken ? "broken axioms of the map: " + broken->text() : "broken axioms of the map",
                    broken.has_value(), 0);
    const double rounding = 1e-12 * mass;
    finding.within("mass [kg]", trial->mass(), deletes ? 0 : mass - rounding, mass + rounding);
    double fastest = 0;
    for (std::size_t i = 0; i < it.vertices(); ++i)
      if (it.program->inverse_mass()[i] > 0)
        fastest = std::max(fastest, it.map->velocity().values()[i].vec().norm());
    finding.at_most("fastest vertex over sound and pull", fastest / (sound * (1 + strain.speed / 8)), 10);
  };
  return one;
}

std::vector<CheckCase> tear_cases() {
  std::vector<CheckCase> all;
  for (const Pulled& body : pulled_bodies())
    for (const ForceLaw& law : body.of == Pulled::Of::Springs ? spring_laws() : element_laws())
      for (const Strain& strain : strains()) all.push_back(tear_case(body, law, strain));
  return all;
}

} // namespace

CheckFamily tear_family() {
  return {"tear", "Tearing under all of these",
          "Every criterion, with a change that fits, on sheets and solids of springs and of elements, pulled "
          "by their ends: as "
          "they are, 1e8 times as stiff, of a micrometre and of a thousand kilometres, pulled a hundred times "
          "as fast, "
          "scrambled, and out of their plane.",
          tear_cases};
}

} // namespace rend
