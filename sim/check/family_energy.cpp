// Energy that nothing gave.
#include "sim/check/families.h"
#include "sim/check/sketch.h"
#include "sim/check/watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

constexpr double simulated_time = 0.5; // [s]
// of peaks; above the stable step the guard may let energy double some times between two looks
constexpr double most_ratio = 5, most_above_limit = 40;

// What moves a body.
struct Cause {
  std::string name, body, world, gravity;
};

const std::vector<Cause>& causes() {
  static const std::vector<Cause> all{
      {"turned and let go", R"(<drive all="yes" rotate="0 0 1 720" until="0.01" then="free"/>)", "", "0 0 0"},
      {"pulled aside", R"(<fix side="-x"/><drive side="+x" velocity="0.2 0 1"/>)", "", "0 0 -5"},
      {"twisted and let go", R"(<fix side="-x"/><drive side="+x" rotate="1 0 0 400" until="0.2" then="free"/>)",
       "", "0 0 0"},
      {"dropped", R"(<contact with="floor"/>)", R"(<floor z="-0.3"/>)", "0 0 -9.81"},
      {"loaded", R"(<fix side="-x"/><load side="+x" force="2 0 5" until="0.2"/>)", "", "0 0 -9.81"},
      {"in wind", R"(<fix side="-x"/>)", R"(<wind velocity="4 3 -6"/>)", "0 0 0"},
      {"pushed by a sphere", R"(<fix side="-x"/><contact with="obstacles"/>)",
       R"(<sphere centre="0.7 0.3 -0.6" radius="0.3" velocity="0 0 2"/>)", "0 0 0"},
      {"hit by a sphere", R"(<fix side="-x"/><contact with="obstacles"/>)",
       R"(<sphere centre="0.7 0.2 0.9" radius="0.2" mass="1"/>)", "0 0 -9.81"}};
  return all;
}

struct Stuff {
  std::string name, body;
};

const std::vector<Stuff>& stuffs() {
  static const std::vector<Stuff> all{
      {"hexahedra", R"(<bar pattern="hexahedra" cells="3 1 2" size="1 0.3 0.3"/><mass total="1"/>)"
                    R"(<elasticity model="corotational" young="2e4" poisson="0.3"/>)"},
      {"mixed solid", R"(<bar pattern="mixed" cells="3 2 1" size="1 0.3 0.3"/><mass total="1"/>)"
                      R"(<elasticity model="corotational" young="2e4" poisson="0.3"/>)"},
      {"tetrahedra", R"(<bar pattern="tetrahedra" cells="3 1 1" size="1 0.3 0.3"/><mass total="5"/>)"
                     R"(<elasticity model="corotational" young="4e5" poisson="0.45"/>)"},
      {"springs",
       R"(<sheet pattern="quads" cells="5 4" size="1 0.6"/><mass total="0.2"/><springs><stretch k="300"/>)"
       R"(<shear kind="isotropic" k="150"/></springs><viscosity value="0.2" per="body"/>)"}};
  return all;
}

struct Peak {
  double energy = 0; // [J], of K + U at its highest
  bool told = false; // stopped, or called doubtful at its end
  std::string why;
};

// At a hundred times of the run: what pictures would show.
Peak peak_of(Scene& scene) {
  Peak peak;
  const long steps = std::max(1L, std::lround(simulated_time / scene.step_size())),
             every = std::max(1L, steps / 100);
  try {
    for (long n = 0; n < steps; ++n) {
      scene.step();
      if (n % every == 0) peak.energy = std::max(peak.energy, scene.kinetic_energy() + scene.elastic_energy());
    }
    scene.check_account();
  } catch (const Unstable& error) {
    peak.told = true;
    peak.why = error.what();
  }
  return peak;
}

CheckCase moved(const Cause& cause, const Stuff& stuff, const Scheme& scheme, double factor) {
  const auto text = [=](const std::string& integrator, const std::string& step) {
    Sketch sketch;
    sketch.body = stuff.body + cause.body;
    sketch.gravity = cause.gravity;
    sketch.world = cause.world;
    sketch.time = time_of(integrator, step, simulated_time);
    return sketch.text();
  };
  CheckCase one;
  one.name = fmt::format("energy/{}/{}/{}/{}", cause.name, stuff.name, scheme.name, factor);
  one.expectation = fmt::format(
      "{:g} times the automatic step of verlet: at none of a hundred times is K + U above {:g} "
      "times its peak with "
      "verlet and a quarter of that step, unless the run is stopped, or called doubtful at its end (above the "
      "stable step, {:g} times is a known limit)",
      factor, most_ratio, most_above_limit);
  one.preset = text("verlet", "auto");
  one.row = cause.name + ", " + stuff.name;
  one.column = fmt::format("{} {:g}", scheme.name, factor);
  one.quick = scheme.name == "symplectic" && stuff.name != "tetrahedra";
  const std::string name = scheme.name;
  one.run = [=](const Bench& bench, Finding& finding) {
    const double step = bench.open()->step_size();
    const Peak known = peak_of(*bench.open_text(text("verlet", in_short(step / 4))).scene);
    const Peak peak = peak_of(*bench.open_text(text(name, in_short(factor * step))).scene);
    finding.what = peak.told
                       ? peak.why
                       : fmt::format("{:.3g} J at most, {:.3g} J with small steps", peak.energy, known.energy);
    finding.at_most("notes of the run in small steps", known.told, 0);
    if (peak.told) return;
    const double ratio = peak.energy / known.energy;
    if (factor > 1 && ratio > most_ratio) {
      finding.at_most("peak over that of small steps", ratio, most_above_limit);
      finding.limit(finding.what, "the step is above the stable one: the guard looks where motion has doubled, "
                                  "and between its looks energy may grow");
    } else {
      finding.at_most("peak over that of small steps", ratio, most_ratio);
    }
  };
  return one;
}

std::vector<CheckCase> energy_cases() {
  std::vector<CheckCase> all;
  for (const Cause& cause : causes())
    for (const Stuff& stuff : stuffs())
      for (const Scheme& scheme : all_schemes()) {
        const bool touches = cause.body.find("<contact") != std::string::npos;
        if (!scheme.has_account() || (touches && scheme.solves && !scheme.solves_contact)) continue;
        for (const double factor : {0.9, 1.3, 4.0}) all.push_back(moved(cause, stuff, scheme, factor));
      }
  return all;
}

} // namespace

CheckFamily energy_family() {
  return {"energy", "Energy that nothing gave",
          "Bodies that are moved in every way, with steps below and above the stable one, under every scheme: "
          "what a "
          "picture would show is compared with the same scene in small steps, without the energy account.",
          energy_cases};
}

} // namespace rend
