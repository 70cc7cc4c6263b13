// Grain: planes against all directions, tried one by one; cracks against the plane of the largest stress over
// strength.
#include "sim/fracture/grain.h"

#include "sim/presets.h"
#include "sim/topology/walk.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace rend::grain_test {
namespace {

constexpr double degree = std::numbers::pi / 180;

double strength_of(const Vec3& n, const std::vector<Vec3>& directions, double ratio) {
  double least = 1;
  for (const Vec3& f : directions) least = std::fmin(least, ratio + (1 - ratio) * std::fabs(n.dot(f)));
  return least;
}

TEST(Grain, the_weakest_plane_is_weaker_than_a_hundred_thousand_others) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const auto direction = [&] { return Vec3(normal(random), normal(random), normal(random)).normalized(); };
  for (int n = 0; n < 40; ++n) {
    const double ratio = 0.05 + 0.02 * n;
    std::vector<Vec3> directions{direction()};
    std::vector<double> along(directions[0].begin(), directions[0].end());
    if (n % 3 == 0) {
      directions.push_back(direction());
      along.insert(along.end(), directions[1].begin(), directions[1].end());
    }
    Eigen::Matrix3d stress;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) stress(r, c) = normal(random);
    stress = (stress + stress.transpose()).eval();
    const Grain::Plane found = Grain({.along = along, .ratio = ratio}).weakest(stress, directions);
    double most = -1e300;
    for (int k = 0; k < 100'000; ++k) {
      const Vec3 d = direction();
      most = std::fmax(most, d.dot(stress * d) / strength_of(d, directions, ratio));
    }
    EXPECT_GE(found.value, most - 1e-9 * std::fabs(most)) << n;
    EXPECT_NEAR(found.value,
                found.normal.dot(stress * found.normal) / strength_of(found.normal, directions, ratio), 1e-12)
        << n;
  }
}

// Of the angle between the fibres and the pull, along x, that between the plane's normal and the pull, tried in
// steps of 0.001 degrees. [degrees]
double expected_turn(double fibres, double ratio) {
  double best = 0, turn = 0;
  for (int k = -90'000; k <= 90'000; ++k) {
    const double angle = 1e-3 * k * degree, c = std::cos(angle);
    const double value = c * c / (ratio + (1 - ratio) * std::fabs(std::cos(angle - fibres * degree)));
    if (value <= best) continue;
    best = value;
    turn = 1e-3 * k;
  }
  return turn;
}

TEST(Grain, under_a_pull_the_plane_is_that_of_the_largest_stress_over_strength) {
  const Eigen::Matrix3d pull = Vec3(1, 0, 0) * Vec3(1, 0, 0).transpose();
  for (double ratio : {0.1, 0.3, 0.6, 1.0})
    for (double fibres : {90.0, 75.0, 60.0, 50.0, 30.0, 10.0}) {
      const std::vector<Vec3> f{{std::cos(fibres * degree), std::sin(fibres * degree), 0}};
      const Vec3 n = Grain({.along = {{f[0].x(), f[0].y(), 0}}, .ratio = ratio}).weakest(pull, f).normal;
      EXPECT_NEAR(n.z(), 0, 1e-5);
      EXPECT_NEAR(std::remainder(std::atan2(n.y(), n.x()) / degree - expected_turn(fibres, ratio), 180), 0,
                  0.01)
          << fibres << ", " << ratio;
    }
}

// A strip from x = 0 to 2 that is pulled along x; or all that turned by a quarter about z.
presets::Loaded strip(const std::string& law, bool turned = false) {
  const double c = turned ? 0 : 1, s = turned ? 1 : 0;
  return presets::load(fmt::format(
      R"(<scene><body><sheet pattern="crossed" cells="24 12" size="2 1"/><place rotate="0 0 {}"/>
         <mass total="0.1"/>
         <elasticity model="corotational" young="1e5" poisson="0" thickness="0.001" damping-stiffness="1e-3"/>
         <drive side="-{}" velocity="{} {} 0"/><drive side="+{}" velocity="{} {} 0"/>{}</body>
         <world gravity="0 0 0"/><time step="auto" integrator="verlet" duration="2"/></scene>)",
      turned ? 90 : 0, turned ? 'y' : 'x', -0.05 * c, -0.05 * s, turned ? 'y' : 'x', 0.05 * c, 0.05 * s, law));
}

double first_tear(const presets::Loaded& scene) {
  while (scene->time() < 2 && scene->tears() == 0) scene->step();
  EXPECT_GT(scene->tears(), 0);
  return scene->time();
}

// Of the edges that have opened within the strip, at rest, against x. [degrees]
double direction_of_crack(const presets::Loaded& scene) {
  const EmbeddedMap& map = *scene.body().map;
  const GMap& g = map.map();
  double c = 0, s = 0;
  g.for_each_dart([&](Dart d) {
    if (!g.is_free(2, d)) return;
    const Vec3 a = map.rest_of(d), b = map.rest_of(g.alpha(0, d)), middle = (a + b) / 2, way = b - a;
    if (middle.x() < 0.01 || middle.x() > 1.99 || middle.y() < 0.01 || middle.y() > 0.99) return;
    const double twice = 2 * std::atan2(way.y(), way.x());
    c += way.norm() * std::cos(twice);
    s += way.norm() * std::sin(twice);
  });
  return std::atan2(s, c) / 2 / degree;
}

TEST(Grain, a_cut_goes_along_the_plane_of_the_largest_stress_over_strength) {
  for (double ratio : {0.1, 0.3, 0.6})
    for (double fibres : {90.0, 80.0, 70.0, 60.0, 45.0}) {
      const auto scene = strip(fmt::format(
          R"(<tear criterion="vertex-stress" threshold="2e3" change="cut" max-per-step="1"
                   grain="{} {} 0" ratio="{}" box="0.9 0.4 -1  1.1 0.6 1"/>)",
          std::cos(fibres * degree), std::sin(fibres * degree), ratio));
      first_tear(scene);
      const double along = direction_of_crack(scene), expected = expected_turn(fibres, ratio) + 90;
      EXPECT_NEAR(std::remainder(along - expected, 180), 0, 2) << fibres << " degrees, " << ratio;
    }
}

TEST(Grain, a_body_is_as_much_weaker_across_its_fibres_as_the_ratio_says) {
  const auto reached = [](const std::string& grain) {
    const auto scene = strip("<tear criterion=\"vertex-stress\" threshold=\"1e9\"" + grain + "/>");
    while (scene->time() < 0.1) scene->step();
    return scene.body().tear_laws.front().reached().value;
  };
  const double plain = reached("");
  ASSERT_GT(plain, 0);
  EXPECT_NEAR(reached(R"( grain="0 1 0" ratio="0.25")"), 4 * plain, 1e-6 * plain); // pulled across the fibres
  EXPECT_NEAR(reached(R"( grain="1 0 0" ratio="0.6")"), plain, 0.05 * plain);      // along them
  EXPECT_NEAR(reached(R"( grain="1 0 0  0 1 0" ratio="0.25")"), 4 * plain, 1e-6 * plain);
  EXPECT_NEAR(reached(R"( grain="0 1 0" ratio="1")"), plain, 1e-9 * plain);
}

TEST(Grain, moves_with_its_body) {
  const std::string law =
      R"(<tear criterion="vertex-stress" threshold="2e3" change="split-vertex" grain="{} {} 0" ratio="0.3"/>)";
  const auto tear = [&](bool turned) {
    const double angle = (turned ? 150 : 60) * degree;
    const auto scene = strip(fmt::format(fmt::runtime(law), std::cos(angle), std::sin(angle)), turned);
    return first_tear(scene);
  };
  EXPECT_NEAR(tear(true), tear(false), 1e-3);
  // Turned by a quarter while it runs: the fibres turn with it.
  presets::Loaded spun = presets::load(
      R"(<scene><body><sheet pattern="crossed" cells="4 4" size="1 1"/><place spin="0 0 90"/><mass total="0.1"/>
         <elasticity model="corotational" young="1e5" poisson="0" thickness="0.001"/></body>
         <world gravity="0 0 0"/><time step="auto" integrator="verlet" duration="2"/></scene>)");
  while (spun->time() < 1) spun->step();
  const EmbeddedMap& map = *spun.body().map;
  const Dart d = map.cells(Vertex).first_dart(12);
  const auto darts = darts_of(map.map(), Vertex, d);
  const Eigen::Matrix3d pull = Vec3(0, 1, 0) * Vec3(0, 1, 0).transpose(); // fibres were along x, are along y
  const Grain grain({.along = {{1, 0, 0}}, .ratio = 0.3});
  const double across =
      grain.weakest(Vec3(1, 0, 0) * Vec3(1, 0, 0).transpose(), map, map.position().values().data(), darts)
          .value;
  EXPECT_NEAR(across, 1 / 0.3, 0.05);
  EXPECT_LT(grain.weakest(pull, map, map.position().values().data(), darts).value, 1.3);
}

TEST(Grain, of_ratio_one_changes_nothing) {
  const auto tear = [](const std::string& grain) {
    return first_tear(
        strip("<tear criterion=\"vertex-stress\" threshold=\"2e3\" change=\"cut\"" + grain + "/>"));
  };
  EXPECT_EQ(tear(""), tear(R"( grain="0.3 1 0" ratio="1")"));
}

} // namespace
} // namespace rend::grain_test
