// A density that differs from element to element: masses, their middle, motion.
#include "sim/body/body.h"
#include "sim/mechanics/mass.h"
#include "sim/presets.h"
#include "sim/topology/walk.h"

#include <Eigen/Eigenvalues>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace rend::density_test {
namespace {

// Σ m x over corners: an element's mass is shared evenly by them.
Vec3 middle_of_mass(const Body& body) {
  Vec3 sum = Vec3::Zero();
  const CellIndex& corners = body.map->cells(body.mass->orbit());
  for (Slot c = 0; c < corners.slots(); ++c)
    if (corners.alive(c)) sum += (*body.mass)[c] * body.map->position_of(corners.first_dart(c));
  return sum / total_mass(*body.map, *body.mass);
}

presets::Loaded bar(const std::string& mass, const std::string& cells,
                    const std::string& pattern = "hexahedra") {
  return presets::load(fmt::format(R"(<scene><body><bar pattern="{}" cells="{}" size="2 0.3 0.5"/><mass {}/>
                                      </body><time step="1e-3" duration="1"/></scene>)",
                                   pattern, cells, mass));
}

const std::string linear = R"-(density="1000*(1 + x(rest))")-";

TEST(Density, that_is_linear_has_the_mass_of_its_integral) {
  // ∫ 1000 (1 + x) dV over 2 x 0.3 x 0.5 m: A (L + L²/2)
  const double whole = 1000 * 0.15 * (2 + 2);
  for (const char* pattern : {"hexahedra", "tetrahedra", "prisms"}) {
    const auto scene = bar(linear, "8 2 2", pattern);
    EXPECT_NEAR(total_mass(*scene.body().map, *scene.body().mass), whole, 1e-9 * whole) << pattern;
  }
}

TEST(Density, puts_the_middle_of_mass_where_its_integral_does) {
  // ∫ x (1 + x) dx / ∫ (1 + x) dx from 0 to 2. With n cells of length h, each of one density, it is lower by
  // (h²/12) / (1 + L/2): exactly.
  const double exact = (2.0 + 8.0 / 3) / 4;
  for (const int n : {4, 8, 16}) {
    const auto scene = bar(linear, fmt::format("{} 1 1", n));
    const double h = 2.0 / n;
    const Vec3 middle = middle_of_mass(scene.body());
    EXPECT_NEAR(middle.x(), exact - h * h / 12 / 2, 1e-12) << n;
    EXPECT_NEAR(middle.y(), 0.15, 1e-12);
    EXPECT_NEAR(middle.z(), 0.25, 1e-12);
  }
}

TEST(Density, of_a_picture_makes_its_dark_half_light) {
  const auto mask = std::make_shared<const Mask>(Mask{4, 1, {0, 0, 1, 1}});
  const auto scene = presets::load(
      R"(<scene><body><sheet cells="8 2" size="4 1"/>
         <mass density="100 + 300*picture" picture="mask.png" thickness="0.01"/></body>
         <time step="1e-3" duration="1"/></scene>)",
      {}, {.is_textured = {}, .read_mask = [&](const auto&) { return mask; }});
  // Cells whose middles are at u = 1/16, 3/16 ... : the two beside the middle, at 7/16 and 9/16, lie a quarter
  // of a pixel from the edge of the pixels, where b is 1/4 and 3/4.
  const double expected = 0.5 * 0.01 * (4 * 100.0 + 4 * 400.0); // each column of cells has 0.5 m2
  EXPECT_NEAR(total_mass(*scene.body().map, *scene.body().mass), expected, 1e-9 * expected);
  const EmbeddedMap& map = *scene.body().map;
  const CellIndex& faces = map.cells(FaceOfVolume);
  for (Slot f = 0; f < faces.slots(); ++f) {
    const Dart d = faces.first_dart(f);
    double x = 0, mass = 0;
    for (Dart e : darts_of(map.map(), Face, d)) {
      x += map.rest_of(e).x() / 8;
      mass += 0.5 * (*scene.body().mass)[map.cells(VertexOfFace).slot(e)]; // two darts to a corner
    }
    const double b = std::clamp(2 * (x - 1.5) / 2, 0.0, 1.0); // between the middles of pixels at 1.5 and 2.5 m
    EXPECT_NEAR(mass, 0.25 * 0.01 * (100 + 300 * b), 1e-12) << x;
  }
}

// Two cells in a row, of 0.1 and 0.3 kg, on springs: three columns of vertices, of which the first is
// held; their motion after gravity is switched on is the sum of two modes.
TEST(Density, moves_a_chain_in_its_own_modes) {
  const double k = 50, g = 1;
  const auto scene = presets::load(fmt::format(
      R"-(<scene><body><sheet cells="2 1" size="2 1"/><mass density="if(x(rest) &lt; 1, 1, 3)" thickness="0.1"/>
         <springs><stretch k="{}"/></springs><fix side="-x"/></body><world gravity="{} 0 0"/>
         <time step="1e-4" integrator="verlet" duration="1"/></scene>)-",
      k, g));
  Eigen::Matrix2d stiffness, mass = Eigen::Matrix2d::Zero();
  stiffness << 4 * k, -2 * k, -2 * k, 2 * k; // each column has two springs to the next
  mass.diagonal() << 0.05 + 0.15, 0.15;      // half of each cell beside it
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d> modes(stiffness, mass);
  const Eigen::Vector2d still = stiffness.ldlt().solve(mass.diagonal() * g);
  while (scene->time() < 0.999) {
    for (int n = 0; n < 100; ++n) scene->step();
    Eigen::Vector2d moved = still;
    for (int n = 0; n < 2; ++n) {
      const Eigen::Vector2d mode = modes.eigenvectors().col(n);
      moved -= mode * mode.dot(mass * still) * std::cos(std::sqrt(modes.eigenvalues()[n]) * scene->time());
    }
    const EmbeddedMap& map = *scene.body().map;
    const CellIndex& vertices = map.cells(Vertex);
    for (Slot v = 0; v < vertices.slots(); ++v) {
      const double rest = map.rest()[v].x, now = map.position()[v].x - rest;
      if (rest < 0.5) continue;
      EXPECT_NEAR(now, moved[rest > 1.5 ? 1 : 0], 1e-4 * still[1]) << scene->time();
    }
  }
}

TEST(Density, of_elements_that_are_cut_keeps_the_mass) {
  const auto scene = presets::load(
      R"-(<scene><body><sheet pattern="crossed" cells="16 4" size="2 0.5"/>
          <mass density="100*(1 + 5*noise(3*rest))" thickness="0.001"/>
          <elasticity young="1e5" poisson="0" thickness="0.001" damping-stiffness="1e-3"/>
          <drive side="-x" velocity="-0.05 0 0"/><drive side="+x" velocity="0.05 0 0"/>
          <tear criterion="vertex-stress" threshold="2e3" change="cut"/></body>
          <world gravity="0 0 0"/><time step="auto" integrator="verlet" duration="2"/></scene>)-");
  const double before = total_mass(*scene.body().map, *scene.body().mass);
  const std::size_t darts = scene.body().map->map().dart_count();
  while (scene->time() < 1 && scene->tears() < 20) scene->step();
  ASSERT_GT(scene.body().map->map().dart_count(), darts) << "some were cut";
  EXPECT_NEAR(total_mass(*scene.body().map, *scene.body().mass), before, 1e-12 * before);
}

TEST(Density, that_is_the_same_everywhere_costs_nothing_and_has_the_bits_of_a_number) {
  const auto number = bar(R"(density="700")", "4 2 2", "tetrahedra"),
             expression = bar(R"(density="600 + 100")", "4 2 2", "tetrahedra");
  EXPECT_EQ(number.body().mass->embedding().by_place, nullptr);
  ASSERT_NE(expression.body().mass->embedding().by_place, nullptr);
  EXPECT_EQ(number.body().mass->values(), expression.body().mass->values());
}

} // namespace
} // namespace rend::density_test
