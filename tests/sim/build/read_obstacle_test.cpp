// Obstacles from mesh files: which have an inside, on which side it is, and which files are none.
#include "sim/build/read_obstacle.h"

#include "sim/mesh_files.h"

namespace rend::read_obstacle_test {
namespace {

using mesh_files::corners_of_box;
using mesh_files::obj;
using mesh_files::quads_of_box;
using mesh_files::written;

MeshObstacle built(const std::string& file, const Placement& place = {}) {
  MeshObstacleSettings settings;
  settings.file = file;
  return build_obstacle(settings, place);
}

const std::vector<Vec3> cube = corners_of_box({0, 0, 0}, {1, 1, 1});

TEST(ReadObstacle, of_a_closed_mesh_has_an_inside_and_its_volume) {
  const MeshObstacle one = built(written("closed.obj", obj(cube, quads_of_box)));
  EXPECT_TRUE(one.surface.closed);
  EXPECT_EQ(one.surface.points.size(), 8u);
  EXPECT_EQ(one.surface.triangles.size(), 12u);
  EXPECT_NEAR(one.volume(), 1, 1e-12);
  EXPECT_TRUE(one.notes.empty());
}

TEST(ReadObstacle, is_scaled_then_rotated_then_moved) {
  const MeshObstacle one = built(written("placed.obj", obj(cube, quads_of_box)),
                                 {.scale = 2, .rotate = {0, 0, 90}, .translate = {10, 0, 0}});
  EXPECT_LT((one.bounds.min() - Vec3(8, 0, 0)).norm(), 1e-12);
  EXPECT_LT((one.bounds.max() - Vec3(10, 2, 2)).norm(), 1e-12);
}

TEST(ReadObstacle, turns_faces_that_are_inside_out_or_do_not_agree_and_says_so) {
  mesh_files::Corners inverted = quads_of_box, mixed = quads_of_box;
  for (auto& quad : inverted) std::reverse(quad.begin(), quad.end());
  std::reverse(mixed[0].begin(), mixed[0].end());
  for (const auto& faces : {inverted, mixed}) {
    const MeshObstacle one = built(written("inverted.obj", obj(cube, faces)));
    EXPECT_TRUE(one.surface.closed);
    EXPECT_NEAR(one.volume(), 1, 1e-12);
    ASSERT_EQ(one.notes.size(), 1u);
    EXPECT_NE(one.notes[0].find("turned outward"), std::string::npos);
  }
}

TEST(ReadObstacle, keeps_the_wall_of_a_hollow_turned_into_it) {
  std::vector<Vec3> points = cube;
  for (const Vec3& x : corners_of_box({0.25, 0.25, 0.25}, {0.75, 0.75, 0.75})) points.push_back(x);
  mesh_files::Corners faces = quads_of_box;
  for (auto quad : quads_of_box) {
    for (std::uint32_t& corner : quad) corner += 8;
    std::reverse(quad.begin(), quad.end());
    faces.push_back(quad);
  }
  const MeshObstacle one = built(written("hollow.obj", obj(points, faces)));
  EXPECT_NEAR(one.volume(), 1 - 0.125, 1e-12);
  EXPECT_TRUE(one.notes.empty());
}

TEST(ReadObstacle, of_an_open_mesh_is_a_sheet) {
  mesh_files::Corners faces = quads_of_box;
  faces.pop_back();
  const MeshObstacle one = built(written("open.obj", obj(cube, faces)));
  EXPECT_FALSE(one.surface.closed);
  EXPECT_EQ(one.surface.triangles.size(), 10u);
}

TEST(ReadObstacle, of_an_off_file_is_the_same) {
  const MeshObstacle one = built(written("tetrahedron.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n"
                                                            "3 0 1 3\n3 1 2 3\n3 2 0 3\n"));
  EXPECT_TRUE(one.surface.closed);
  EXPECT_NEAR(one.volume(), 1.0 / 6, 1e-12);
}

std::string refusal_of(const std::string& file, Exit code = Exit::BadInput) {
  try {
    built(file);
  } catch (const UserError& error) {
    EXPECT_EQ(error.code, code);
    return error.what();
  }
  return "none";
}

TEST(ReadObstacle, refuses_files_that_are_none) {
  const auto expect = [](const std::string& words, const std::string& part) {
    EXPECT_NE(words.find(part), std::string::npos) << words;
  };
  expect(refusal_of("/no/such/mesh.obj", Exit::NoInput), "mesh.obj");
  EXPECT_NE(refusal_of(written("points.obj", "v 0 0 0\nv 1 0 0\n")), "none");
  EXPECT_NE(refusal_of(written("nan.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")), "none");
  expect(refusal_of(written("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")), "area");
  expect(refusal_of(written("zero.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n")), "area");
  mesh_files::Corners fin = quads_of_box;
  fin.push_back({0, 1, 7});
  EXPECT_NE(refusal_of(written("fin.obj", obj(cube, fin))), "none");
  expect(refusal_of(written("twice.obj", obj({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                                             {{0, 1, 2}, {0, 2, 3}, {1, 0, 3}, {1, 3, 2}}))),
         "encloses no volume");
}

} // namespace
} // namespace rend::read_obstacle_test
