// Contact with obstacles that are meshes: as with the box or sphere of the same shape, and never passed.
#include "sim/base/archive.h"
#include "sim/heaps.h"
#include "sim/mesh_files.h"

#include <cstdlib>

namespace rend::mesh_obstacle_test {
namespace {

using presets::Loaded;

void run(const Loaded& scene, double until) {
  while (scene->time() < until - 1e-9) scene->step();
}

Vec3 mean(const std::vector<Record>& values) {
  Vec3 sum = Vec3::Zero();
  for (const Record& x : values) sum += x.vec();
  return sum / static_cast<double>(values.size());
}

Vec3 mean_position(const Loaded& scene) {
  return mean(scene.body().map->position().values());
}

double height(const Loaded& scene) { // of the highest vertex
  double most = -1e300;
  for (const Record& x : scene.body().map->position().values()) most = std::max(most, x.z);
  return most;
}

std::string obstacle(const std::string& file, const std::string& attributes = "",
                     const std::string& children = "") {
  return fmt::format(R"(<obstacle file="{}" {}>{}</obstacle>)", file, attributes, children);
}

std::string scene(const std::string& body, const std::string& world, const std::string& gravity = "0 0 -10",
                  const std::string& time = R"(step="2e-4" integrator="symplectic" duration="4")") {
  return "<scene><body>" + body + "</body><world gravity=\"" + gravity + "\">" + world + "</world><time " +
         time + "/></scene>";
}

const std::string lump = R"(<bar cells="2 2 2" size="0.2 0.2 0.2"/><mass total="1"/><contact/>
    <elasticity model="corotational" young="2e4" poisson="0.2" damping-mass="8" damping-stiffness="2e-3"/>)";

TEST(MeshObstacle, a_lump_rests_on_a_closed_cube_as_high_as_on_the_box) {
  const std::string above = lump + R"(<place rotate="0 0 20" translate="-0.1 -0.1 0.51"/>)";
  const std::string file = mesh_files::box("rest.obj", {-0.5, -0.5, 0}, {0.5, 0.5, 0.5});
  const Loaded box = presets::load(scene(above, R"(<box low="-0.5 -0.5 0" high="0.5 0.5 0.5"/>)")),
               mesh = presets::load(scene(above, obstacle(file)));
  for (const Loaded* one : {&box, &mesh}) run(*one, 1.5);
  EXPECT_NEAR(mean_position(mesh).z(), mean_position(box).z(), 1e-4);
  EXPECT_LT(mean(mesh.body().map->velocity().values()).norm(), 1e-3);
}

TEST(MeshObstacle, a_corner_of_a_mesh_under_the_middle_of_a_large_face_holds_it) {
  const std::string spike = mesh_files::written(
      "spike.obj", mesh_files::obj({{-0.1, -0.1, 0}, {0.1, -0.1, 0}, {0, 0.12, 0}, {0, 0, 0.5}},
                                   {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}));
  const Loaded sheet = presets::load(
      scene(R"(<sheet pattern="triangles" cells="1 1" size="1 1"/><place translate="-0.4 -0.6 0.52"/>
        <mass total="0.1"/><springs><stretch k="500" damping="0.5"/><shear kind="isotropic" k="500"/></springs>
        <viscosity value="0.2" per="body"/><contact thickness="0.01"/>)",
            obstacle(spike)));
  double lowest = 1;
  while (sheet->time() < 0.4) { // before it tips over and slides off
    sheet->step();
    for (const auto& body : sheet->contacts()->bodies())
      ASSERT_EQ(heaps::crossings(*sheet.scene), 0) << body->called() << " at " << sheet->time();
    lowest = std::min(lowest, mean_position(sheet).z());
  }
  EXPECT_GT(lowest, 0.3);
}

TEST(MeshObstacle, a_cloth_lies_on_a_mesh_of_a_ball_as_on_the_sphere) {
  const std::string cloth = R"(<sheet pattern="crossed" cells="10 10" size="0.8 0.8"/>
      <place translate="-0.4 -0.4 0.31"/><mass total="0.1"/>
      <springs><stretch k="60" damping="0.02"/><bend kind="angular" k="1e-4"/></springs>
      <viscosity value="0.2" per="body"/><contact thickness="0.01" friction="0.8"/>)";
  const double radius = 0.3;
  const Loaded sphere = presets::load(scene(cloth, R"(<sphere centre="0 0 0" radius="0.3"/>)", "0 0 -10",
                                            R"(step="auto" integrator="symplectic" duration="4")")),
               mesh = presets::load(scene(cloth, obstacle(mesh_files::ball("ball.obj", radius, 3)), "0 0 -10",
                                          R"(step="auto" integrator="symplectic" duration="4")"));
  for (const Loaded* one : {&sphere, &mesh}) run(*one, 0.8);
  const double sagitta = 0.02 * radius; // of sides of 0.15 radii: 1 - sqrt(1 - 0.15^2)
  EXPECT_NEAR(height(mesh), height(sphere), 0.01 + sagitta);
  EXPECT_NEAR(mean_position(mesh).z(), mean_position(sphere).z(), 0.02);
  EXPECT_EQ(heaps::crossings(*mesh.scene), 0);
}

TEST(MeshObstacle, pushes_what_is_in_its_way_at_its_velocity_and_does_work_on_it) {
  const std::string file = mesh_files::box("ram.obj", {-0.3, -0.2, -0.2}, {0, 0.4, 0.4});
  const Loaded pushed = presets::load(
      scene(lump + R"(<place translate="0.02 0 0"/>)", obstacle(file, R"(velocity="0.5 0 0")"), "0 0 0"));
  run(pushed, 1.5);
  const Vec3 velocity = mean(pushed.body().map->velocity().values());
  EXPECT_NEAR(velocity.x(), 0.5, 0.02);
  const EnergyFigures energy = pushed->energy();
  EXPECT_GT(energy.now.work.contact.obstacles, 0.5 * 0.5 * 0.5 * 0.9);
  EXPECT_LT(energy.balance, 1e-3 * energy.scale);
}

TEST(MeshObstacle, that_turns_drags_along_what_lies_on_it) {
  const std::string file = mesh_files::box("table.obj", {-1, -1, 0}, {1, 1, 0.5});
  const Loaded lies = presets::load(scene(lump + R"(<place translate="0.3 -0.1 0.502"/>)",
                                          obstacle(file, R"(rotate="0 0 1 60" friction="1")")));
  run(lies, 0.5);
  const double radius = mean_position(lies).head<2>().norm();
  const Vec3 from = mean_position(lies);
  run(lies, 1.5);
  const Vec3 to = mean_position(lies);
  EXPECT_NEAR(to.head<2>().norm(), radius, 0.01);
  EXPECT_NEAR(std::atan2(to.y(), to.x()) - std::atan2(from.y(), from.x()), 1.047, 0.03);
}

TEST(MeshObstacle, is_a_wall_from_both_sides_where_it_is_open) {
  const std::string file = mesh_files::written(
      "wall.obj", mesh_files::obj({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2, 3}}));
  for (const double side : {1.0, -1.0}) {
    const Loaded falls =
        presets::load(scene(lump + fmt::format(R"(<place translate="-0.1 -0.1 {}"/>)", side > 0 ? 0.1 : -0.3),
                            obstacle(file), side > 0 ? "0 0 -10" : "0 0 10"));
    run(falls, 1);
    EXPECT_NEAR(side * mean_position(falls).z(), 0.102, 3e-3) << side;
  }
}

TEST(MeshObstacle, stops_falling_spheres_as_the_box_does) {
  const std::string file = mesh_files::box("balls.obj", {-0.5, -0.5, 0}, {0.5, 0.5, 0.5});
  const std::string far = lump + R"(<place translate="9 9 9"/>)";
  const std::string ball =
      R"(<sphere centre="0.1 0.05 {}" radius="0.1" mass="1" velocity="0.3 0 {}" friction="0.2"/>)";
  for (const auto& [height, speed] :
       {std::pair(0.7, 0.0), std::pair(1.0, -600.0)}) { // the fast one in one step
    const std::string falls = fmt::format(fmt::runtime(ball), height, speed);
    const Loaded box = presets::load(scene(far, falls + R"(<box low="-0.5 -0.5 0" high="0.5 0.5 0.5"/>)")),
                 mesh = presets::load(scene(far, falls + obstacle(file)));
    for (const Loaded* one : {&box, &mesh}) run(*one, 0.6);
    const Sphere &on_box = (*box.scene).world().spheres[0], &on_mesh = (*mesh.scene).world().spheres[0];
    EXPECT_LT((on_mesh.centre - on_box.centre).norm(), 2e-3) << on_mesh.centre.transpose();
    EXPECT_NEAR(on_mesh.centre.z(), 0.6, 1e-3);
  }
}

TEST(MeshObstacle, holds_a_sphere_between_the_sides_of_a_valley) {
  const std::string valley = mesh_files::written(
      "valley.obj", mesh_files::obj({{-1, -1, 1}, {0, -1, 0}, {1, -1, 1}, {-1, 1, 1}, {0, 1, 0}, {1, 1, 1}},
                                    {{0, 1, 4, 3}, {1, 2, 5, 4}}));
  const Loaded rolls = presets::load(
      scene(lump + R"(<place translate="9 9 9"/>)",
            R"(<sphere centre="0.2 0 0.6" radius="0.1" mass="1" friction="0"/>)" + obstacle(valley)));
  run(rolls, 3);
  const Sphere& sphere = (*rolls.scene).world().spheres[0];
  EXPECT_GT(sphere.centre.z() - std::abs(sphere.centre.x()), 0.1 * std::sqrt(2.0) - 1e-3);
  EXPECT_LT(sphere.centre.z(), 0.6);
}

// Whose faces are much larger than it is thick: a vertex above it lies behind the faces of its far side.
TEST(MeshObstacle, lets_go_of_what_rises_from_a_thin_plate) {
  const std::string file = mesh_files::box("plate.obj", {-3, -3, -0.1}, {3, 3, 0});
  const Loaded rises =
      presets::load(scene(lump + R"(<place translate="0 0 0.01" velocity="0 0 2"/>)", obstacle(file), "0 0 0"));
  rises->step();
  rises->step();
  EXPECT_GT(mean(rises.body().map->velocity().values()).z(), 1.9);
  EXPECT_FALSE(rises.body().work_meter->work().contact.touched);
}

TEST(MeshObstacle, has_friction_of_its_own) {
  const std::string file = mesh_files::box("slope.obj", {-3, -3, -1}, {3, 3, 0});
  const auto slides = [&](const std::string& on) { // 5 m/s² along x, 10 across
    const Loaded one = presets::load(scene(lump + R"(<place translate="-2 0 0.003"/>)", on, "5 0 -10"));
    run(one, 0.5);
    return mean(one.body().map->velocity().values()).x();
  };
  EXPECT_NEAR(slides(obstacle(file, R"(friction="0.9")")), 0, 0.01);
  EXPECT_NEAR(slides(obstacle(file, R"(friction="0.1")")),
              slides(R"(<box low="-3 -3 -1" high="3 3 0" friction="0.1"/>)"), 1e-3);
}

TEST(MeshObstacle, is_passed_by_what_does_not_meet_it_at_no_cost) {
  const std::string file = mesh_files::box("passed.obj", {-1, -1, -1}, {1, 1, 0});
  const std::string through =
      R"(<bar cells="1 1 1" size="0.2 0.2 0.2"/><place translate="0 0 0.1"/><mass total="1"/>
      <elasticity young="1e4"/><contact with="obstacles" not="ground"/>)";
  const Loaded falls = presets::load(scene(through, obstacle(file, R"(name="ground")")));
  EXPECT_EQ(falls->contacts()->fragments(), nullptr);
  run(falls, 0.5);
  EXPECT_NEAR(mean_position(falls).z(), 0.2 - 0.5 * 10 * 0.25, 0.01);
}

TEST(MeshObstacle, is_told_by_the_work_meter_as_touched) {
  const std::string file = mesh_files::box("told.obj", {-1, -1, -1}, {1, 1, 0});
  const Loaded falls = presets::load(scene(lump + R"(<place translate="0 0 0.01"/>)",
                                           R"(<sphere centre="9 9 9" radius="1"/>)" + obstacle(file)));
  const std::size_t number = falls->world().number_of_mesh(0);
  EXPECT_FALSE(falls.body().work_meter->touched(number));
  run(falls, 0.2);
  EXPECT_TRUE(falls.body().work_meter->touched(number));
  EXPECT_FALSE(falls.body().work_meter->touched(falls->world().number_of_sphere(0)));
}

// Its coefficient of restitution, and where it is.
const std::string flat = R"(<sheet cells="3 3" size="0.3 0.3"/><mass total="0.1"/>
    <springs><stretch k="60"/></springs><contact thickness="0.002" restitution="{}"/><place translate="{}"/>)";

TEST(MeshObstacle, gives_back_the_share_e_of_the_speed_with_which_it_is_struck) {
  const std::string file = mesh_files::box("struck.obj", {-1, -1, -0.5}, {1, 1, 0});
  for (const double e : {0.0, 0.5, 0.9})
    for (const double own : {0.0, -1.5, 1.0}) { // [m/s], of the obstacle
      const std::string above = fmt::format(fmt::runtime(flat), e, R"(-0.1 -0.1 0.1" velocity="0 0 -4)");
      const Loaded falls =
          presets::load(scene(above, obstacle(file, fmt::format(R"(velocity="0 0 {}")", own)), "0 0 0"));
      run(falls, 0.1);
      for (const Record& v : falls.body().map->velocity().values())
        EXPECT_NEAR(v.z, own + e * (4 + own), 1e-9) << e << " " << own;
    }
}

TEST(MeshObstacle, has_restitution_of_its_own) {
  const std::string file = mesh_files::box("springy.obj", {-1, -1, -0.5}, {1, 1, 0});
  const std::string above = fmt::format(fmt::runtime(flat), 0.2, R"(-0.1 -0.1 0.1" velocity="0 0 -4)");
  const Loaded falls = presets::load(scene(above, obstacle(file, R"(restitution="0.7")"), "0 0 0"));
  run(falls, 0.1);
  EXPECT_NEAR(mean(falls.body().map->velocity().values()).z(), 0.7 * 4, 1e-9);
}

// A cube of six tetrahedra about its diagonal, of Gmsh's format 2.2.
std::string solid_cube(const Vec3& low, const Vec3& high) {
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n8\n";
  const std::vector<Vec3> points = mesh_files::corners_of_box(low, high);
  for (std::size_t n = 0; n < 8; ++n)
    text += fmt::format("{} {} {} {}\n", n + 1, points[n].x(), points[n].y(), points[n].z());
  text += "$EndNodes\n$Elements\n6\n";
  constexpr std::array<std::array<int, 4>, 6> cells{
      {{1, 2, 4, 8}, {1, 4, 3, 8}, {1, 3, 7, 8}, {1, 7, 5, 8}, {1, 5, 6, 8}, {1, 6, 2, 8}}};
  int number = 0;
  for (const auto& [a, b, c, d] : cells) text += fmt::format("{} 4 2 1 1 {} {} {} {}\n", ++number, a, b, c, d);
  return mesh_files::written("solid.msh", text + "$EndElements\n");
}

TEST(MeshObstacle, that_is_read_from_a_solid_holds_a_lump_as_its_surface_does) {
  const std::string above = lump + R"(<place rotate="0 0 20" translate="-0.1 -0.1 0.51"/>)";
  const Vec3 low(-0.5, -0.5, 0), high(0.5, 0.5, 0.5);
  const Loaded surface = presets::load(scene(above, obstacle(mesh_files::box("skin.obj", low, high)))),
               solid = presets::load(scene(above, obstacle(solid_cube(low, high))));
  EXPECT_EQ(solid->world().meshes.front().surface.triangles.size(), 12u);
  for (const Loaded* one : {&surface, &solid}) run(*one, 1.5);
  EXPECT_NEAR(mean_position(solid).z(), mean_position(surface).z(), 1e-4);
  EXPECT_NEAR(mean_position(solid).z(), 0.6, 0.01);
}

// Closed ones, and all that a sphere may fall on, are in a tree: nine coordinates and more a triangle.
TEST(MeshObstacle, counts_the_bytes_of_its_tree) {
  const std::string wall = mesh_files::written(
      "counted.obj", mesh_files::obj(mesh_files::corners_of_box({-1, -1, -1}, {1, 1, 0}),
                                     {mesh_files::quads_of_box.begin(), mesh_files::quads_of_box.end() - 1}));
  const std::string box = mesh_files::box("counted-box.obj", {-1, -1, -1}, {1, 1, 0}),
                    falls = R"(<sphere centre="5 5 5" radius="0.1" mass="1"/>)";
  const auto bytes = [](const std::string& world) {
    const Loaded one = presets::load(scene(lump + R"(<place translate="0 0 3"/>)", world));
    one->step();
    return one->contacts()->bytes();
  };
  constexpr std::size_t tree = 9 * sizeof(double), without = 1000; // bytes a triangle; of all else at most
  EXPECT_GT(bytes(obstacle(box)), bytes(obstacle(wall)) + 12 * tree);
  EXPECT_GT(bytes(obstacle(wall) + falls), bytes(obstacle(wall)) + 10 * tree);
  EXPECT_LT(bytes(obstacle(box)), bytes(obstacle(wall)) + 12 * 2 * tree + without);
}

std::string refusal_of(const std::string& preset) {
  try {
    presets::load(preset);
  } catch (const UserError& error) {
    return error.what();
  }
  return "none";
}

TEST(MeshObstacle, refuses_what_starts_inside_of_it_or_moves_it_out) {
  const std::string file = mesh_files::box("start.obj", {-0.5, -0.5, -0.5}, {0.5, 0.5, 0});
  const std::string inside = R"(<bar cells="2 2 2" size="0.2 0.2 0.2"/><place translate="0 0 -0.05"/>
      <mass total="1"/><elasticity young="1e4"/><contact thickness="0.002" overlap="{}"/>)";
  const std::string refused = refusal_of(scene(fmt::format(fmt::runtime(inside), "refuse"), obstacle(file)));
  EXPECT_NE(refused.find("body 'body' starts 0.05 m inside obstacle 1"), std::string::npos) << refused;
  const Loaded moved = presets::load(scene(fmt::format(fmt::runtime(inside), "push"), obstacle(file)));
  EXPECT_NEAR(mean_position(moved).z(), 0.102, 1e-9);
  const std::string around = R"(<bar cells="1 1 1" size="3 3 3"/><place translate="-1.5 -1.5 -1.5"/>
      <mass total="1"/><elasticity young="1e4"/><contact/>)";
  EXPECT_NE(refusal_of(scene(around, obstacle(file))).find("inside obstacle 1"), std::string::npos);
}

TEST(MeshObstacle, is_refused_in_words_by_schemes_that_solve) {
  const std::string file = mesh_files::box("solved.obj", {-1, -1, -1}, {1, 1, 0});
  for (const char* name : {"implicit", "static"}) {
    const std::string words =
        refusal_of(scene(lump + R"(<place translate="0 0 1"/>)", obstacle(file), "0 0 -10",
                         fmt::format(R"(step="1e-3" integrator="{}" duration="1")", name)));
    EXPECT_NE(words.find("meets an <obstacle>"), std::string::npos) << words;
  }
}

int heaps() { // as many as the time allows
  return std::getenv("REND_WHOLE") ? 100 : 10;
}

// A cube, and a wall that is open; both stand, or both turn.
std::string surroundings(bool turning) {
  const std::string cube = mesh_files::box("heap-cube.obj", {-0.1, -0.1, 0}, {0.4, 0.7, 0.3});
  const std::string wall = mesh_files::written(
      "heap-wall.obj",
      mesh_files::obj({{0.5, -0.3, 0.05}, {1, -0.3, 0.35}, {1, 1, 0.35}, {0.5, 1, 0.05}}, {{0, 1, 2, 3}}));
  const std::string motion = turning ? R"(rotate="0.3 0.2 1 90" centre="0.3 0.3 0")" : "";
  return R"(<world gravity="0 0 -9.81">)" + obstacle(cube, motion) + obstacle(wall, motion) + "</world>";
}

TEST(MeshObstacle, that_moves_goes_on_from_a_stored_state_bit_for_bit) {
  const std::string preset = heaps::heap(3, surroundings(true));
  const Loaded whole = presets::load(preset), again = presets::load(preset);
  for (int n = 0; n < 2400; ++n) whole->step();
  EXPECT_TRUE(std::ranges::any_of(whole->bodies(), [&](const auto& body) {
    return body->work_meter->touched(whole->world().number_of_mesh(0)) ||
           body->work_meter->touched(whole->world().number_of_mesh(1));
  }));
  for (int n = 0; n < 2900; ++n) again->step(); // what it has listed there is of no use
  Archive written;
  whole->store(written);
  Archive read(std::span<const std::uint8_t>(written.bytes()));
  again->store(read);
  for (int n = 0; n < 400; ++n) {
    whole->step();
    again->step();
  }
  EXPECT_EQ(whole->hash(), again->hash());
}

TEST(MeshObstacle, is_never_crossed_by_random_heaps) {
  for (const bool turning : {false, true})
    for (int seed = 0; seed < heaps(); ++seed) {
      const Loaded scene = presets::load(heaps::heap(seed, surroundings(turning)));
      ASSERT_EQ(heaps::crossings(*scene.scene), 0);
      for (int n = 0; n < 3000; ++n) {
        scene->step();
        if (n % 10 != 0) continue;
        ASSERT_EQ(heaps::crossings(*scene.scene), 0)
            << "heap " << seed << ", turning " << turning << ", step " << n;
      }
      const EnergyFigures energy = scene->energy();
      EXPECT_LT(energy.balance, 1e-3 * energy.scale) << seed;
    }
}

} // namespace
} // namespace rend::mesh_obstacle_test
