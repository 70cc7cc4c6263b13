// Natural frequencies: eigenvalues of the assembled stiffness over the lumped masses, against those of bars
// and beams that are fixed at one end (tests/README.md, "Closed forms"), and against the bound that limits the
// step.
#include "sim/rows/vertex_bounds.h"

#include "sim/base/math.h"
#include "sim/elements.h"
#include "sim/ground_springs.h"
#include "sim/presets.h"
#include "sim/random_meshes.h"
#include "sim/scene/scene.h"

#include <Eigen/Eigenvalues>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace rend::frequency_test {
namespace {

// Angular frequencies [rad/s] of the body at rest, increasing: the roots of the eigenvalues of M^-1/2 K M^-1/2
// over the free coordinates.
std::vector<double> frequencies(Body& body) {
  std::vector<std::uint8_t> held(body.vertices(), 0);
  body.mark_prescribed(0, held.data());
  BlockMatrix stiffness;
  stiffness.reset(body.pattern());
  body.add_stiffness(meshes::positions(body), meshes::velocities(body), Tangent::Exact, 1, 0, stiffness);

  std::vector<int> place(3 * body.vertices(), -1);
  int free = 0;
  for (std::size_t c = 0; c < place.size(); ++c)
    if ((held[c / 3] >> (c % 3) & 1) == 0) place[c] = free++;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(free, free);
  const BlockPattern& p = *body.pattern();
  const double* inverse_mass = body.program->inverse_mass();
  for (std::uint32_t i = 0; i < p.rows(); ++i)
    for (std::uint32_t b = p.start[i]; b < p.start[i + 1]; ++b) {
      const std::uint32_t j = p.column[b];
      const double mass = 1 / std::sqrt(inverse_mass[i] * inverse_mass[j]);
      for (int k = 0; k < 9; ++k) {
        const int row = place[3 * i + static_cast<std::uint32_t>(k / 3)];
        const int column = place[3 * j + static_cast<std::uint32_t>(k % 3)];
        if (row >= 0 && column >= 0) matrix(row, column) = stiffness.at(b)(k / 3, k % 3) / mass;
      }
    }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix, Eigen::EigenvaluesOnly);
  std::vector<double> found;
  for (const double value : solver.eigenvalues()) found.push_back(std::sqrt(std::max(0.0, value)));
  return found;
}

std::vector<double> frequencies(const std::string& in_body) {
  const auto s = presets::load("<scene><body>" + in_body +
                               R"(<fix side="-x"/></body><world gravity="0 0 0"/>)"
                               R"(<time step="1" integrator="static" duration="1"/></scene>)");
  return frequencies(s.body());
}

// c = √(E/ρ) = 10 m/s. A chain of n lumped masses, the last of them a half, has 2 n c/L sin((2i − 1) π/(4 n)),
// exactly.
TEST(Frequencies, of_a_bar_along_itself) {
  constexpr int n = 40;
  const auto found = frequencies(
      R"(<bar cells="40 1 1" size="1 0.02 0.02"/><mass density="1000"/><fix all="yes" axes="yz"/>
         <elasticity model="linear" young="1e5" poisson="0"/>)");
  for (int i = 1; i <= 5; ++i) {
    const double chain = 2 * n * 10.0 * std::sin((2 * i - 1) * pi / (4 * n));
    const double bar = 2 * pi * (2 * i - 1) / 4.0 * 10.0;
    EXPECT_NEAR(found[static_cast<std::size_t>(i) - 1], chain, 1e-9 * chain) << i;
    EXPECT_NEAR(found[static_cast<std::size_t>(i) - 1], bar, 0.006 * bar) << i;
  }
}

// ω = β² √(E I/(ρ A)). Cells of length a in a beam of height h cannot bend (shear locking), and are stiffer by
// a²/(2 h²). The remaining error grows with the mode: shear, and masses at the surface.
TEST(Frequencies, of_a_beam_across) {
  struct Case {
    std::string body;
    double length, height, tolerance;
  };
  for (const Case& c : {Case{R"(<sheet cells="160 1" size="1 0.02"/><mass density="1000" thickness="0.01"/>
               <fix all="yes" axes="z"/><elasticity model="linear" young="1e5" poisson="0" thickness="0.01"/>)",
                             1.0 / 160, 0.02, 0.01},
                        Case{R"(<bar cells="60 1 1" size="1 0.02 0.03"/><mass density="1000"/>
               <fix all="yes" axes="y"/><elasticity model="linear" young="1e5" poisson="0"/>)",
                             1.0 / 60, 0.03, 0.02}}) {
    const auto found = frequencies(c.body);
    const double stiffness = 1 + c.length * c.length / (2 * c.height * c.height);
    const double betas[] = {1.875104, 4.694091, 7.854757};
    for (std::size_t i = 0; i < 3; ++i) {
      const double beam = betas[i] * betas[i] * 10 * c.height * std::sqrt(stiffness / 12);
      EXPECT_NEAR(found[i], beam, c.tolerance * beam) << c.body << i;
    }
  }
}

// Bodies of one interaction that a vertex owns, which every fragment of a split vertex takes over.
std::unique_ptr<Body> body_of(std::unique_ptr<EmbeddedMap> map,
                              std::unique_ptr<Interaction> (*make)(EmbeddedMap&)) {
  auto body = std::make_unique<Body>();
  body->map = std::move(map);
  CornerMass mass;
  mass.density = 0.1;
  body->mass = &body->map->add(mass.on(*body->map));
  body->interactions.push_back(make(*body->map));
  body->prepare(*find_scheme("implicit"));
  return body;
}

double bound_of(const Body& body) {
  return std::sqrt(frequency_bounds(*body.map, body.interactions, *body.mass, nullptr).omega_squared);
}

// Separates borders at random, all of them in the end, and looks at the body in between.
template <class F> void separate_all(Body& body, F&& look) {
  const int dimension = body.map->dimension();
  std::vector<Dart> borders;
  body.map->map().for_each_dart([&](Dart d) {
    if (!body.map->map().is_free(dimension, d)) borders.push_back(d);
  });
  meshes::Noise noise(5);
  for (std::size_t n = borders.size(); n > 1; --n) std::swap(borders[n - 1], borders[noise.below(n)]);
  const std::size_t some = borders.size() / 2 + 1;
  for (std::size_t n = 0; n < borders.size(); ++n) {
    body.map->edit([&](Edit& edit) { unsew(edit, dimension, borders[n]); });
    if (n % some != 0 && n + 1 < borders.size()) continue;
    body.rebind();
    look();
  }
}

presets::Loaded slit_sheet(const std::string& pattern, const std::string& along) {
  return presets::load(fmt::format(
      R"(<scene><body><sheet pattern="{}" cells="8 5" size="2 1"/><slit along="{}"/>
           <mass density="1000" thickness="1e-3"/>
           <elasticity model="corotational" young="1e5" poisson="0.3" thickness="1e-3"/></body>
         <world gravity="0 0 0"/><time step="1" integrator="static" duration="1"/></scene>)",
      pattern, along));
}

presets::Loaded torn_bar() {
  return presets::load(R"(<scene><body><bar pattern="tetrahedra" cells="6 2 2" size="3 1 1"/>
      <mass density="1000"/><elasticity model="corotational" young="1e5" poisson="0.3" damping-mass="2"/>
      <drive side="-x" velocity="-0.3 0 0"/><drive side="+x" velocity="0.3 0 0"/>
      <tear criterion="vertex-stress" threshold="4e3" change="cut" max-per-step="1"/></body>
      <world gravity="0 0 0"/><time step="5e-3" integrator="implicit" duration="2"/></scene>)");
}

double bound(Body& body, int rounds) {
  return std::sqrt(
      VertexBounds(*body.map, body.interactions, *body.mass, body.drag).bounds(rounds).omega_squared);
}

// A slit leaves elements of many sizes.
TEST(VertexBounds, come_down_to_the_highest_frequency_and_stay_above_it) {
  double first = 0, last = 0;
  for (const std::string pattern : {"triangles", "crossed"})
    for (const std::string along : {"0.13 0.2 0  1.71 0.55 0", "0.4 -0.1 0  1.2 1.1 0"}) {
      const auto scene = slit_sheet(pattern, along);
      Body& body = scene.body();
      const double highest = frequencies(body).back();
      double above =
          std::sqrt(frequency_bounds(*body.map, body.interactions, *body.mass, nullptr).omega_squared);
      for (int rounds = 0; rounds < 8; ++rounds) {
        const double now = bound(body, rounds);
        EXPECT_GE(now, highest) << pattern << along;
        EXPECT_LE(now, above) << pattern << along;
        above = now;
      }
      first += bound(body, 0) / highest / 4;
      last += bound(body, 4) / highest / 4;
    }
  EXPECT_LT(last, 1.25);
  EXPECT_LT(last, 0.9 * first);
}

TEST(VertexBounds, that_were_kept_through_cuts_are_those_found_anew) {
  const auto scene = torn_bar();
  Body& body = scene.body();
  VertexBounds kept(*body.map, body.interactions, *body.mass, body.drag);
  kept.bounds();
  const std::vector<Record> start = body.map->rest().values();
  std::size_t tears = 0;
  int compared = 0;
  while (scene->time() < 1.2 && compared < 60) {
    scene->step();
    if (scene->tears() == tears) continue;
    tears = scene->tears();
    ++compared;
    const FrequencyBounds now = kept.bounds(),
                          anew = VertexBounds(*body.map, body.interactions, *body.mass, body.drag).bounds();
    ASSERT_EQ(now.omega_squared, anew.omega_squared);
    ASSERT_EQ(now.damping_rate, anew.damping_rate);
    ASSERT_EQ(now.least_drag_rate, anew.least_drag_rate);
  }
  EXPECT_GT(compared, 10);
  const std::vector<Record>& rest = body.map->rest().values();
  std::size_t moved = 0;
  for (std::size_t v = 0; v < start.size(); ++v) moved += start[v].vec() != rest[v].vec() ? 1 : 0;
  EXPECT_GT(moved, 0u);
  EXPECT_GE(bound(body, 4), frequencies(body).back());
}

// A spring from each vertex to its place: √(k/m) of the lightest vertex, which in the end is the lightest
// corner.
TEST(FrequencyBound, of_springs_to_the_ground_is_that_of_the_lightest_fragment_to_come) {
  for (auto& each : elements::irregular_maps()) {
    SCOPED_TRACE(each.name);
    const auto body = body_of(std::move(each.map), [](EmbeddedMap& map) { return ground::springs(map, 3); });
    const auto highest = [&] {
      const double* inverse_mass = body->program->inverse_mass();
      return std::sqrt(3 * *std::max_element(inverse_mass, inverse_mass + body->vertices()));
    };
    const double bound = bound_of(*body);
    EXPECT_LE(highest(), bound * (1 + 1e-12));
    separate_all(*body, [&] {
      EXPECT_EQ(bound_of(*body), bound) << "a separation changes no corner";
      EXPECT_LE(highest(), bound * (1 + 1e-12));
    });
    EXPECT_NEAR(highest(), bound, 1e-12 * bound);
  }
}

TEST(FrequencyBound, of_springs_from_vertices_to_their_neighbours_holds_before_and_after_separations) {
  for (auto& each : elements::irregular_maps()) {
    SCOPED_TRACE(each.name);
    const auto body =
        body_of(std::move(each.map), [](EmbeddedMap& map) { return ground::springs_to_neighbours(map, 3); });
    const double bound = bound_of(*body);
    EXPECT_LE(frequencies(*body).back(), bound);
    separate_all(*body, [&] {
      EXPECT_EQ(bound_of(*body), bound);
      EXPECT_LE(frequencies(*body).back(), bound);
    });
    EXPECT_GE(frequencies(*body).back(), 0.5 * bound) << "it is not far from what is needed";
  }
}

} // namespace
} // namespace rend::frequency_test
