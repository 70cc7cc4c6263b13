#include "sim/mesh/polygons.h"

#include "sim/mechanics/interaction.h"
#include "sim/topology/count.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <stdexcept>

#include "sim/random_meshes.h"
#include "sim/topology/walk.h"

namespace rend::polygons_test {
namespace {

using testing::HasSubstr;

PolygonMesh points_of(std::size_t count) {
  PolygonMesh mesh;
  for (std::size_t n = 0; n < count; ++n)
    mesh.points.push_back(Vec3(double(n), double(n * n % 7), double(n % 3)));
  return mesh;
}

std::string refusal_of(const PolygonMesh& mesh) {
  try {
    sheet_from(mesh);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "not refused";
}

TEST(SheetFromPolygons, holds_every_polygon_with_its_points) {
  for (const meshes::Named& each : meshes::irregular()) {
    SCOPED_TRACE(each.name);
    const PolygonMesh& mesh = each.mesh;
    const auto map = sheet_from(mesh);
    ASSERT_EQ(validate(*map), std::nullopt);
    EXPECT_EQ(count_cells(map->map(), FaceOfVolume), mesh.polygons());
    EXPECT_EQ(map->map().dart_count(), 2 * mesh.corners.size());
    for (std::size_t p = 0; p < mesh.polygons(); ++p) { // darts are numbered polygon by polygon, side by side
      Dart d{2 * mesh.first[p]};
      EXPECT_EQ(sides_of_face(map->map(), d), static_cast<int>(mesh.first[p + 1] - mesh.first[p]));
      for (std::uint32_t corner = mesh.first[p]; corner < mesh.first[p + 1]; ++corner) {
        EXPECT_EQ(map->position_of(d), mesh.points[mesh.corners[corner]]);
        EXPECT_EQ(map->rest_of(d), mesh.points[mesh.corners[corner]]);
        EXPECT_EQ(map->velocity()[map->vertex(d)].vec(), Vec3::Zero());
        d = map->map().alpha(1, map->map().alpha(0, d));
      }
    }
  }
}

TEST(SheetFromPolygons, sews_exactly_the_sides_that_two_polygons_share) {
  for (const meshes::Named& each : meshes::irregular()) {
    SCOPED_TRACE(each.name);
    const PolygonMesh& mesh = each.mesh;
    std::map<std::set<std::uint32_t>, int> sides; // the two points → how many polygons
    for (std::size_t p = 0; p < mesh.polygons(); ++p)
      for (std::uint32_t c = mesh.first[p]; c < mesh.first[p + 1]; ++c)
        ++sides[{mesh.corners[c], mesh.corners[c + 1 < mesh.first[p + 1] ? c + 1 : mesh.first[p]]}];
    std::size_t shared = 0;
    for (const auto& [points, polygons] : sides) shared += polygons == 2;
    const auto map = sheet_from(mesh);
    std::size_t sewn = 0;
    map->map().for_each_dart([&](Dart d) {
      if (map->map().is_free(2, d)) return;
      ++sewn;
      EXPECT_EQ(map->vertex(d), map->vertex(map->map().alpha(2, d)));
    });
    EXPECT_EQ(sewn, 4 * shared);
    EXPECT_EQ(count_cells(map->map(), Edge), sides.size());
    EXPECT_EQ(map->cells(Vertex).count(), mesh.points.size());
  }
}

TEST(SheetFromPolygons, lets_neighbours_disagree_in_orientation) {
  PolygonMesh agreeing = points_of(4), disagreeing = points_of(4);
  agreeing.add({0, 1, 2});
  agreeing.add({2, 1, 3});
  disagreeing.add({0, 1, 2});
  disagreeing.add({1, 2, 3});
  for (const PolygonMesh* mesh : {&agreeing, &disagreeing}) {
    const auto map = sheet_from(*mesh);
    ASSERT_EQ(validate(*map), std::nullopt);
    const CellCounts counts = count_cells(map->map());
    EXPECT_EQ(counts.vertices, 4u);
    EXPECT_EQ(counts.edges, 5u);
    EXPECT_EQ(counts.euler, 1);
  }
}

TEST(SheetFromPolygons, closes_a_sphere_and_a_pillow) {
  PolygonMesh tetrahedron = points_of(4);
  tetrahedron.add({0, 1, 2});
  tetrahedron.add({0, 1, 3});
  tetrahedron.add({1, 2, 3});
  tetrahedron.add({2, 0, 3});
  PolygonMesh pillow = points_of(3); // two triangles sewn along all their sides
  pillow.add({0, 1, 2});
  pillow.add({2, 1, 0});
  for (const PolygonMesh* mesh : {&tetrahedron, &pillow}) {
    const auto map = sheet_from(*mesh);
    ASSERT_EQ(validate(*map), std::nullopt);
    EXPECT_EQ(count_cells(map->map()).euler, 2);
  }
}

TEST(SheetFromPolygons, gives_fans_that_meet_at_a_point_a_vertex_each) {
  PolygonMesh mesh = points_of(5);
  mesh.add({0, 1, 2});
  mesh.add({0, 3, 4});
  const auto map = sheet_from(mesh);
  ASSERT_EQ(validate(*map), std::nullopt);
  EXPECT_EQ(map->cells(Vertex).count(), 6u);
  EXPECT_EQ(count_cells(map->map()).fragments, 2u);
}

TEST(SheetFromPolygons, takes_nothing) {
  EXPECT_EQ(sheet_from(PolygonMesh{})->map().dart_count(), 0u);
}

TEST(SheetFromPolygons, numbers_vertices_as_polygons_meet_them) {
  PolygonMesh mesh = points_of(4);
  mesh.add({3, 1, 0});
  mesh.add({1, 3, 2});
  const auto map = sheet_from(mesh);
  const std::vector<std::uint32_t> met{3, 1, 0, 2};
  for (Slot v = 0; v < 4; ++v) EXPECT_EQ(map->position()[v].vec(), mesh.points[met[v]]);
}

TEST(SheetFromPolygons, refuses_what_a_sheet_cannot_hold) {
  PolygonMesh book = points_of(5); // three polygons at one edge
  book.add({0, 1, 2});
  book.add({0, 1, 3});
  book.add({1, 0, 4});
  EXPECT_THAT(refusal_of(book), HasSubstr("polygon 2: shares the edge between points 1 and 0"));
  PolygonMesh repeated = points_of(4);
  repeated.add({0, 1, 2, 3});
  repeated.add({0, 1, 2, 1});
  EXPECT_THAT(refusal_of(repeated), HasSubstr("polygon 1: meets point 1 twice"));
  PolygonMesh beyond = points_of(3);
  beyond.add({0, 1, 3});
  EXPECT_THAT(refusal_of(beyond), HasSubstr("polygon 0: has a corner 3, and there are 3 points"));
  PolygonMesh flat = points_of(3);
  flat.add({0, 1});
  EXPECT_THAT(refusal_of(flat), HasSubstr("polygon 0: has fewer than three corners"));
  PolygonMesh twice = points_of(3); // a polygon three times
  for (int n = 0; n < 3; ++n) twice.add({0, 1, 2});
  EXPECT_THAT(refusal_of(twice), HasSubstr("polygon 2"));
}

} // namespace
} // namespace rend::polygons_test
