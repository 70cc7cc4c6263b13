// Spheres and boxes: against elementary geometry, Coulomb's and Newton's laws, and for what must never happen.
#include "sim/contact/contact_faces.h"
#include "sim/outside/obstacle.h"

#include "sim/presets.h"
#include "sim/random_meshes.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace rend::obstacle_test {
namespace {

using meshes::Noise;

TEST(Obstacle, a_triangle_s_nearest_point_is_nearer_than_any_of_many) {
  Noise noise(1);
  for (int n = 0; n < 200; ++n) {
    const TriangleCorners x{noise.vector(), noise.vector(), noise.vector()};
    const Vec3 point = 2 * noise.vector();
    const auto at = [&](const Weights& w) { return Vec3(w[0] * x[0] + w[1] * x[1] + w[2] * x[2]); };
    const double found = (at(nearest_in_triangle(x, point)) - point).norm();
    for (int i = 0; i <= 20; ++i)
      for (int j = 0; j <= 20 - i; ++j)
        EXPECT_LE(found, (at({i / 20.0, j / 20.0, (20 - i - j) / 20.0}) - point).norm() + 1e-12);
  }
}

double box_distance(const Box& box, const Vec3& x) {
  const Vec3 beyond = (x - 0.5 * (box.low + box.high)).cwiseAbs() - 0.5 * (box.high - box.low);
  return beyond.cwiseMax(0).norm() + std::min(0.0, beyond.maxCoeff());
}

TEST(Obstacle, a_triangle_s_deepest_point_in_a_box_is_as_deep_as_any_of_many) {
  Noise noise(2);
  const Box box{{-0.6, -0.4, -0.5}, {0.5, 0.4, 0.3}};
  for (int n = 0; n < 200; ++n) {
    const TriangleCorners x{1.5 * noise.vector(), 1.5 * noise.vector(), 1.5 * noise.vector()};
    const auto at = [&](const Weights& w) { return Vec3(w[0] * x[0] + w[1] * x[1] + w[2] * x[2]); };
    const auto distance = [&](const Weights& w) {
      return ((at(w) - 0.5 * (box.low + box.high)).cwiseAbs() - 0.5 * (box.high - box.low)).maxCoeff();
    };
    const double found = distance(deepest_in_box(x, box));
    double least = 1e300;
    for (int i = 0; i <= 40; ++i)
      for (int j = 0; j <= 40 - i; ++j)
        least = std::min(least, distance({i / 40.0, j / 40.0, (40 - i - j) / 40.0}));
    EXPECT_LE(found, least + 0.01); // for a triangle of size 3
  }
}

TEST(Obstacle, a_sphere_stops_what_comes_in_on_the_side_where_it_does) {
  EXPECT_FALSE(Sphere::stop({2, 0, 0}, {1.1, 0, 0}, 1));
  EXPECT_THAT(Sphere::stop({2, 0, 0}, {0.9, 0, 0}, 1)->normal, Vec3(1, 0, 0));
  EXPECT_THAT(Sphere::stop({2, 0, 0}, {-0.5, 0, 0}, 1)->normal, Vec3(1, 0, 0)) << "past the middle";
  EXPECT_THAT(Sphere::stop({3, 0, 0}, {-3, 0, 0}, 1)->normal, Vec3(1, 0, 0)) << "right through";
  EXPECT_FALSE(Sphere::stop({3, 1.1, 0}, {-3, 1.1, 0}, 1));
  EXPECT_FALSE(Sphere::stop({0, 1, 0}, {0.1, 0.999, 0}, 0.995)) << "grazing";
  EXPECT_FALSE(Sphere::stop({3, 0.99, 0}, {-3, 0.99, 0}, 1)) << "grazing";
  for (double aside : {0.1, 0.5, 0.6, 0.9, 0.97})
    for (double end : {-3.0, 0.0}) {
      if (end == 0 && aside > 0.6) continue; // above the corner, where both are nearly the same
      const auto plane = Sphere::stop({3, aside, 0}, {end, aside, 0}, 1);
      ASSERT_TRUE(plane);
      EXPECT_LT((plane->normal - Vec3(std::sqrt(1 - aside * aside), aside, 0)).norm(), 1e-9)
          << aside << " aside, where it comes in";
    }
}

TEST(Obstacle, a_box_stops_what_comes_in_through_the_side_where_it_does) {
  const Box box{{0, 0, 0}, {1, 1, 0.01}};
  EXPECT_FALSE(box.stop({0.5, 0.5, 1}, {0.5, 0.5, 0.1}, 0.05));
  EXPECT_EQ(box.stop({0.5, 0.5, 1}, {0.5, 0.5, -1}, 0.05)->normal, Vec3(0, 0, 1)) << "right through";
  EXPECT_NEAR(box.stop({0.5, 0.5, 1}, {0.5, 0.5, -1}, 0.05)->offset, 0.06, 1e-15);
  EXPECT_EQ(box.stop({-1, 0.5, 0.005}, {0.2, 0.5, 0.005}, 0)->normal, Vec3(-1, 0, 0));
  EXPECT_EQ(box.stop({0.5, 0.5, 0.009}, {0.5, 0.5, 0.002}, 0)->normal, Vec3(0, 0, 1)) << "from inside";
  EXPECT_FALSE(box.stop({-1, 0.5, 0.5}, {0.5, -1, 0.5}, 0));
  EXPECT_FALSE(box.stop({1.2, 0.5, 0.02}, {0.5, 1.2, 0.02}, 0)) << "above";
}

// A stiff block on a box, under tilted gravity.
presets::Loaded block(const std::string& gravity, const std::string& friction) {
  return presets::load(R"(<scene><body><bar cells="2 2 1" size="0.2 0.2 0.1"/><place translate="0 0 0.502"/>
      <mass total="1"/><elasticity model="corotational" young="2e4" poisson="0.3" damping-stiffness="0.01"/>
      <contact/></body><world gravity=")" +
                       gravity + R"("><box low="-2 -2 0" high="4 2 0.5" friction=")" + friction +
                       R"("/></world><time step="2e-4" duration="2"/></scene>)");
}

Vec3 mean_velocity(const presets::Loaded& scene) {
  return scene->momentum() / scene->mass();
}

TEST(ObstacleContact, a_block_slides_if_the_tangent_is_above_friction_and_as_fast_as_coulomb_says) {
  const double g = 10, down = 8, along = 6; // tan = 0.75
  for (double friction : {0.2, 0.5}) {
    const auto slides = block("6 0 -8", std::to_string(friction));
    while (slides->time() < 0.3) slides->step();
    const double start = mean_velocity(slides).x(), from = slides->time();
    while (slides->time() < 0.6) slides->step();
    const double measured = (mean_velocity(slides).x() - start) / (slides->time() - from);
    EXPECT_NEAR(measured, along - friction * down, 0.01 * g) << friction;
  }
  const auto stays = block("6 0 -8", "0.8");
  while (stays->time() < 0.3) stays->step();
  const Vec3 there = stays.body().map->position()[0];
  while (stays->time() < 0.6) stays->step();
  EXPECT_LT((stays.body().map->position()[0].vec() - there).norm(), 1e-5);
  EXPECT_LT(mean_velocity(stays).norm(), 1e-4);
}

// The total momentum of a falling sphere and a free cloth.
TEST(ObstacleContact, a_sphere_that_hits_a_free_cloth_shares_its_momentum_with_it) {
  const auto scene = presets::load(R"(<scene><body><sheet pattern="triangles" cells="12 12" size="1 1"/>
      <mass total="0.2"/><springs><stretch k="80"/></springs><contact thickness="0.01" friction="0.4"/></body>
      <world gravity="0 0 0">
      <sphere centre="0.45 0.52 0.3" radius="0.15" velocity="0.5 0 -5" mass="0.3"/></world>
      <time step="1e-3" duration="1"/></scene>)");
  const Vec3 before = scene->momentum();
  double energy = scene->kinetic_energy() + scene->elastic_energy();
  for (int n = 0; n < 100; ++n) {
    scene->step();
    EXPECT_LT((scene->momentum() - before).norm(), 1e-13 * (n + 1));
    EXPECT_LE(scene->kinetic_energy() + scene->elastic_energy(), 1.02 * energy)
        << n; // oscillations of symplectic Euler
  }
  EXPECT_LT(scene->world().spheres[0].velocity.norm(), 4.5);
  EXPECT_LT(total_momentum(*scene.body().map, *scene.body().mass).z(), -0.05);
}

// The largest penetration of vertices and faces of the cloth [m].
double deepest(const presets::Loaded& scene) {
  double most = 0;
  const auto& x = scene.body().map->position();
  Boundary boundary(*scene.body().map, scene.body().border);
  const ContactFaces faces(*scene.body().map, boundary);
  for (const ContactFaces::Triangle& t : faces.triangles())
    for (int i = 0; i <= 6; ++i)
      for (int j = 0; j <= 6 - i; ++j) {
        const Vec3 at =
            (i * x[t.vertex[0]].vec() + j * x[t.vertex[1]].vec() + (6 - i - j) * x[t.vertex[2]].vec()) / 6;
        for (const Sphere& s : scene->world().spheres) most = std::max(most, s.radius - (at - s.centre).norm());
        for (const Box& b : scene->world().boxes) most = std::max(most, -box_distance(b, at));
      }
  return most;
}

TEST(ObstacleContact, cloth_over_sphere_and_box_shows_nothing_of_them) {
  const auto scene = presets::load(R"(<scene><body><sheet pattern="triangles" cells="16 16" size="1 1"/>
      <place translate="-0.5 -0.5 0.5"/><mass total="0.2"/>
      <springs><stretch k="80" damping="0.05"/><bend kind="provot" k="2"/></springs>
      <viscosity value="0.3" per="body"/><contact thickness="0.01" friction="0.3"/></body>
      <world><sphere centre="-0.2 0 0.2" radius="0.2"/><sphere centre="0.1 0.3 0.42" radius="0.02"/>
      <box low="0.1 -0.2 0" high="0.4 0.2 0.4"/></world><time step="1e-3" duration="1"/></scene>)");
  for (int n = 0; n < 800; ++n) {
    scene->step();
    if (n % 40 == 0) {
      ASSERT_LT(deepest(scene), 0.004) << n;
    }
  }
}

TEST(ObstacleContact, a_fast_sphere_does_not_pass_through_a_cloth) {
  for (const char* speed : {"-5", "-10"}) {
    for (const char* radius : {"0.03", "0.2"}) { // with cells of 0.1
      const auto scene = presets::load(
          std::string(R"(<scene><body><sheet cells="10 10" size="1 1"/><mass total="0.2"/>
          <springs><stretch k="80"/><shear k="40"/></springs><contact/></body><world gravity="0 0 0">
          <sphere centre="0.55 0.45 0.3" radius=")") +
          radius + R"(" velocity="0 0 )" + speed + R"("/></world><time step="1e-3" duration="1"/></scene>)");
      for (int n = 0; n < 80; ++n) {
        scene->step();
        ASSERT_LT(deepest(scene), 0.002);
      }
      const Sphere& sphere = scene->world().spheres[0];
      double lowest = 1e300;
      for (const Record& x : scene.body().map->position().values())
        lowest = std::min(lowest, x.z - sphere.centre.z());
      EXPECT_LT(lowest, -0.9 * sphere.radius) << "the cloth is carried before it";
    }
  }
}

// A small cloth beside the centre of the path of a sphere. Both stay on their side of the tangent plane at the
// contact, and the relative normal velocity becomes 0: within an error of the order of the step.
TEST(ObstacleContact, a_fast_sphere_does_not_pass_what_it_hits_aside) {
  for (const double step : {1e-5, 1e-3, 1e-2}) { // 0.7, 70 and 700 mm a step
    for (const double aside : {0.14, 0.16, 0.2, 0.28}) {
      const auto scene = presets::load(fmt::format(
          R"(<scene><body><sheet cells="1 1" size="0.001 0.001"/><place translate="{} -0.0005 0"/>
          <mass total="0.01"/><springs><stretch k="0.01"/></springs>
          <contact thickness="0.002" friction="0"/></body><world gravity="0 0 0">
          <sphere centre="0 0 0.31" radius="0.3" velocity="0 0 -70" mass="1"/></world>
          <time step="{}" duration="1"/></scene>)",
          aside, step));
      while (scene->time() < 0.0199) scene->step();
      const double sine = aside / 0.302, cosine = std::sqrt(1 - sine * sine);
      const Vec3 normal(sine, 0, -cosine), pushed = 70 * cosine / 1.01 * normal; // by a sphere of 1 kg
      const Vec3 got = total_momentum(*scene.body().map, *scene.body().mass) / 0.01;
      const double tolerance = step < 1e-4 ? 0.02 : 0.7;
      EXPECT_LT((got - pushed).norm(), tolerance * pushed.norm())
          << aside << ' ' << step << ' ' << got.transpose();
      for (const Record& x : scene.body().map->position().values())
        EXPECT_GT((x.vec() - scene->world().spheres[0].centre).norm(), 0.3) << aside << ' ' << step;
    }
  }
}

TEST(ObstacleContact, spheres_are_caught_by_a_held_cloth_a_box_and_the_floor) {
  const auto scene = presets::load(R"(<scene><body><sheet pattern="triangles" cells="8 8" size="1 1"/>
      <place translate="0 0 1"/><mass total="0.2"/><springs><stretch k="200" damping="0.05"/></springs>
      <viscosity value="2" per="body"/><contact thickness="0.01"/><fix side="-x"/><fix side="+x"/></body>
      <world><floor z="0"/><box low="2 0 0" high="3 1 0.5"/>
      <sphere centre="0.5 0.5 1.2" radius="0.15" mass="0.3"/>
      <sphere centre="2.5 0.5 0.8" radius="0.1" mass="2"/>
      <sphere centre="5 5 1" radius="0.25" mass="1"/></world><time step="5e-4" duration="4"/></scene>)");
  while (scene->time() < 4) scene->step();
  const auto& spheres = scene->world().spheres;
  EXPECT_GT(spheres[0].centre.z(), 0.3);
  EXPECT_LT(spheres[0].velocity.norm(), 0.3) << "it swings";
  const double fall = 9.81 * 5e-4 * 5e-4; // per step
  EXPECT_NEAR(spheres[1].centre.z(), 0.6, fall);
  EXPECT_NEAR(spheres[2].centre.z(), 0.25, fall);
  EXPECT_LT(deepest(scene), 0.004);
}

TEST(ObstacleContact, is_the_same_on_two_threads_and_is_in_the_hash) {
  const auto run = [](int threads, const std::string& x) {
    SceneOptions options;
    options.threads = threads;
    const auto scene = presets::load(
        R"(<scene><body><sheet cells="20 20" size="1 1"/><mass total="0.2"/>
        <springs><stretch k="80"/></springs><contact/></body><world><box low="0 0 -0.5" high="0.4 0.4 -0.1"/>
        <sphere centre=")" +
            x + R"( 0.5 0.2" radius="0.1" mass="0.2"/></world><time step="1e-3" duration="1"/></scene>)",
        options);
    for (int n = 0; n < 200; ++n) scene->step();
    return scene->hash();
  };
  EXPECT_EQ(run(1, "0.5"), run(2, "0.5"));
  EXPECT_NE(run(1, "5"), run(1, "6")) << "far from the cloth";
}

TEST(ObstacleContact, costs_a_body_nothing_that_meets_the_floor_alone) {
  const std::string start = R"(<scene><body><sheet cells="4 4" size="1 1"/><mass total="1"/>
      <springs><stretch k="60"/></springs>)",
                    end = R"(<time step="1e-3" duration="1"/></scene>)";
  const auto floor = presets::load(start + R"(<contact/></body><world><floor/></world>)" + end);
  EXPECT_FALSE(floor.body().contact->faces());
  EXPECT_TRUE(floor.body().floor_contact);
  EXPECT_THROW(presets::load(start + "<contact/></body>" + end), UserError);
  EXPECT_THROW(
      presets::load(
          start + R"(<contact with="floor"/></body><world><sphere centre="0 0 0" radius="1"/></world>)" + end),
      UserError);
}

double total_energy(const presets::Loaded& scene) {
  return scene->kinetic_energy() + scene->elastic_energy() + scene->gravity_energy();
}

// A sheet fixed along z only yields to a sphere from above no more than one that is fixed along all axes.
TEST(ObstacleContact, a_sphere_rests_on_a_sheet_that_is_held_along_its_fall) {
  const auto scene = presets::load(R"(<scene><body><sheet pattern="triangles" cells="12 12" size="1 1"/>
      <place translate="0 0 0.5"/><mass total="0.2"/><springs><stretch k="200"/></springs>
      <contact thickness="0.004"/><fix all="yes" axes="z"/></body>
      <world><sphere centre="0.47 0.53 0.7" radius="0.12" mass="5"/></world>
      <time step="1e-3" duration="0.6"/></scene>)");
  const double start = total_energy(scene);
  double last = start;
  while (scene->time() < 0.6) {
    scene->step();
    ASSERT_LE(total_energy(scene), last + 1e-9 * start) << scene->time();
    last = std::min(last, total_energy(scene));
  }
  EXPECT_NEAR(scene->world().spheres[0].centre.z(), 0.624, 0.003);
  EXPECT_LT(scene->world().spheres[0].velocity.norm(), 0.02);
}

// Initial overlap is resolved slowly. The elastic energy of a bar inflated around a sphere is at most about
// Young's modulus times the sphere's volume; when overlap was resolved at once, a bar of 6 cells a side got
// 1.5e5 J.
TEST(ObstacleContact, a_bar_that_is_released_around_a_sphere_or_box_is_not_thrown_about) {
  for (const char* obstacle :
       {R"(<sphere centre="0.5 0.5 0.5" radius="0.35"/>)", R"(<box low="0.3 0.3 0.3" high="0.7 0.7 0.7"/>)"}) {
    const auto scene = presets::load(std::string(R"(<scene><body>
        <bar pattern="tetrahedra" cells="4 4 4" size="1 1 1"/><mass density="200"/>
        <elasticity model="corotational" young="4e4" poisson="0.3"/><contact friction="0"/>
        <drive all="yes" velocity="0 0 0" until="1e-6" then="free"/></body>
        <world gravity="0 0 0">)") + obstacle +
                                     R"(</world><time step="auto" duration="0.3"/></scene>)");
    while (scene->time() < 0.3) {
      scene->step();
      ASSERT_LT(scene->kinetic_energy() + scene->elastic_energy(), 4e4 * 0.18) << scene->time();
    }
  }
}

// The faces beside the clamp are in contact, with only one movable vertex each: it must not be thrown off.
TEST(ObstacleContact, leaves_a_body_at_rest_that_is_held_where_it_touches) {
  const auto scene = presets::load(
      R"(<scene><body><bar cells="4 1 1" size="1.2 0.3 0.3"/><place translate="0 0 0.5"/><mass density="1000"/>
      <elasticity young="1e5"/><fix side="-x"/><contact/></body><world gravity="0 0 0">
      <box low="-0.1 -0.1 0" high="0 0.4 0.9"/></world><time step="auto" duration="0.1"/></scene>)");
  while (scene->time() < scene->duration()) scene->step();
  const Body& body = scene.body();
  for (Slot v = 0; v < body.vertices(); ++v)
    EXPECT_LT((body.map->position()[v].vec() - body.map->rest()[v].vec()).norm(), 1e-3);
}

} // namespace
} // namespace rend::obstacle_test
