// Every scheme has its order of convergence on whole scenes with smooth motion: springs, elements, dampers,
// drives, loads.
#include "sim/presets.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace rend::order_test {
namespace {

struct Smooth {
  std::string name, body; // the content of <body>
  std::string world = "";
};

// Small bodies, over some radians of their fastest mode.
const std::vector<Smooth>& smooth_scenes() {
  const std::string cloth = R"(<sheet pattern="quads" cells="3 3" size="1 1"/><place rotate="90 0 0"/>)"
                            R"(<mass total="0.1"/>)";
  const std::string bar = R"(<bar pattern="tetrahedra" cells="3 1 1" size="1 0.3 0.3"/><mass density="100"/>)";
  const std::string corners = R"(<fix near="0 0 1"/><fix near="1 0 1"/>)";
  const std::string springs = R"(<springs><stretch k="60"/><shear kind="isotropic" k="43"/></springs>)";
  static const std::vector<Smooth> scenes{
      {"springs", cloth + springs + corners},
      {"springs with dampers",
       cloth + corners +
           R"(<springs><stretch k="60" damping="0.05"/><shear kind="anisotropic" k="43" damping="0.02"/>)"
           R"(<bend kind="angular" k="0.05" damping="1e-3"/></springs>)"},
      {"springs in a viscous fluid", cloth + springs + corners + R"(<viscosity value="0.02" per="particle"/>)"},
      {"springs in a wind", cloth + springs + corners, R"(<wind velocity="0 3 0"/>)"},
      {"springs, driven round",
       cloth + R"(<springs><stretch k="60" damping="0.05"/><shear kind="isotropic" k="43"/></springs>)"
               R"(<drive side="+z" rotate="0 1 0 200" centre="0.5 0 0.5"/>)"},
      {"springs, pulled", cloth + springs +
                              R"(<fix side="+z"/><drive side="-z" velocity="0.3 0.4 -0.5"/>)"
                              R"(<viscosity value="0.1" per="body"/>)"},
      {"co-rotational tetrahedra",
       bar +
           R"(<elasticity model="corotational" young="1e4"/><fix side="-x"/><load side="+x" force="0 1 2"/>)"},
      {"linear tetrahedra", bar + R"(<elasticity model="linear" young="1e4"/><fix side="-x"/>)"
                                  R"(<viscosity value="0.5" per="particle"/>)"},
      {"co-rotational hexahedra under pressure",
       R"(<bar pattern="hexahedra" cells="3 1 1" size="1 0.3 0.3"/><mass density="100"/>)"
       R"(<elasticity model="corotational" young="1e4"/><drive side="-x" rotate="1 0 0 90"/>)"
       R"(<load side="+x" pressure="40"/>)"},
  };
  return scenes;
}

constexpr double end_time = 0.125; // [s]

struct Reached {
  std::vector<Record> position, velocity;
  std::vector<double> mass; // [kg]
};

Reached reached(const Smooth& smooth, const std::string& scheme, int steps) {
  const auto s = presets::load(fmt::format(
      R"(<scene><body>{}</body><world>{}</world><time step="{:.17g}" integrator="{}" duration="{}"/></scene>)",
      smooth.body, smooth.world, end_time / steps, scheme, end_time));
  for (int n = 0; n < steps; ++n) s->step();
  Reached out{s.body().map->position().values(), s.body().map->velocity().values(), {}};
  for (std::size_t i = 0; i < out.position.size(); ++i)
    out.mass.push_back(1 / s.body().program->inverse_mass()[i]);
  return out;
}

struct Errors {
  double position = 0, velocity = 0; // mass-weighted means [m], [m/s]
  double both() const { return std::hypot(position / end_time, velocity); }
};

Errors between(const Reached& a, const Reached& b) {
  double x = 0, v = 0, mass = 0;
  for (std::size_t i = 0; i < a.mass.size(); ++i) {
    x += a.mass[i] * (a.position[i].vec() - b.position[i].vec()).squaredNorm();
    v += a.mass[i] * (a.velocity[i].vec() - b.velocity[i].vec()).squaredNorm();
    mass += a.mass[i];
  }
  return {std::sqrt(x / mass), std::sqrt(v / mass)};
}

// Position and velocity together have the order to within a tenth; each by itself at least: without damping and
// from rest, symplectic Euler is the leapfrog scheme of order 2 with positions shifted by half a step, and its
// velocities are of that order.
TEST(Orders, are_reached_on_smooth_scenes) {
  for (const Smooth& smooth : smooth_scenes()) {
    const Reached exact = reached(smooth, "rk4", 4096);
    for (const Scheme& scheme : all_schemes()) {
      if (scheme.adaptive || scheme.name == "static") continue;
      const int steps = scheme.order == 1 ? 2048 : 256;
      const Errors one = between(reached(smooth, scheme.name, steps), exact),
                   two = between(reached(smooth, scheme.name, 2 * steps), exact);
      EXPECT_NEAR(std::log2(one.both() / two.both()), scheme.order, 0.1) << scheme.name << ", " << smooth.name;
      EXPECT_GT(std::log2(one.position / two.position), scheme.order - 0.1)
          << scheme.name << ", " << smooth.name;
      EXPECT_GT(std::log2(one.velocity / two.velocity), scheme.order - 0.1)
          << scheme.name << ", " << smooth.name;
    }
  }
}

} // namespace
} // namespace rend::order_test
