// The bound of the highest frequency until something is separated is above the true one; found anew and kept,
// it is the same.
#include "sim/rows/vertex_bounds.h"

#include "sim/presets.h"
#include "sim/scene/scene.h"

#include <Eigen/Eigenvalues>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace rend::vertex_bounds_test {
namespace {

// [1/s], at rest.
double highest_frequency(Body& body) {
  const auto n = static_cast<Eigen::Index>(body.program->vertices());
  const double* inverse_mass = body.program->inverse_mass();
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  UnitMatrix by_position, by_velocity;
  for (const auto& interaction : body.interactions) {
    const CellIndex& owners = body.map->cells(interaction->pattern.owner);
    for (Slot owner = 0; owner < owners.slots(); ++owner) {
      if (!owners.alive(owner)) continue;
      const std::vector<Word>& words = interaction->pattern.units[0];
      std::vector<Vec3> rest(words.size()), still(words.size(), Vec3::Zero());
      std::vector<Eigen::Index> at;
      for (std::size_t k = 0; k < words.size(); ++k) {
        const Dart d = body.map->map().follow(owners.first_dart(owner), words[k]);
        rest[k] = body.map->rest_of(d);
        at.push_back(body.map->vertex(d));
      }
      interaction->law->stiffness(interaction->unit(owner, 0), {rest.data(), still.data(), rest.data()},
                                  Tangent::Exact, by_position, by_velocity);
      for (std::size_t a = 0; a < at.size(); ++a)
        for (std::size_t b = 0; b < at.size(); ++b)
          K.block<3, 3>(3 * at[a], 3 * at[b]) +=
              by_position.block<3, 3>(3 * static_cast<Eigen::Index>(a), 3 * static_cast<Eigen::Index>(b));
    }
  }
  for (Eigen::Index v = 0; v < n; ++v) {
    const double scale = std::sqrt(inverse_mass[v]);
    K.middleRows<3>(3 * v) *= scale;
    K.middleCols<3>(3 * v) *= scale;
  }
  return std::sqrt(
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K, Eigen::EigenvaluesOnly).eigenvalues()[3 * n - 1]);
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
      <tear criterion="vertex-stress" threshold="4e3" change="cut"/></body>
      <world gravity="0 0 0"/><time step="auto" duration="2"/></scene>)");
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
      const double highest = highest_frequency(body);
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
  RecordProperty("first", std::to_string(first));
  RecordProperty("last", std::to_string(last));
  EXPECT_LT(last, 1.25);
  EXPECT_LT(last, 0.9 * first);
}

TEST(VertexBounds, that_were_kept_through_cuts_are_those_found_anew) {
  const auto scene = torn_bar();
  Body& body = scene.body();
  VertexBounds kept(*body.map, body.interactions, *body.mass, body.drag);
  kept.bounds();
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
  EXPECT_GT(compared, 5);
  EXPECT_GE(bound(body, 4), highest_frequency(body));
}

} // namespace
} // namespace rend::vertex_bounds_test
