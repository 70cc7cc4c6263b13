// Grids whose points are split where a picture has a seam, against the same grids before: cells are where they
// were, and each corner has its own place.
#include "sim/export/seams.h"

#include "sim/house_rules/house_rules.h"
#include "sim/presets.h"
#include "sim/rules/apply.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace rend::seams_test {
namespace {

// A sheet of triangles and quads beside volumes of all kinds.
constexpr const char* scene_text = R"(<scene>
  <body name="a"><bar cells="1 1 1" size="1 1 1"/><mass total="1"/></body>
  <body name="b"><sheet pattern="mixed" cells="4 3" size="4 3"/>
    <place translate="5 0 0"/><mass total="2"/></body>
  <body name="c"><bar pattern="mixed" cells="4 2 2" size="4 2 2"/>
    <place translate="0 5 0"/><mass total="3"/></body>
  <body name="d"><sheet cells="1 1" size="1 1"/><place translate="0 0 9"/><mass total="1"/></body>
  <world><sphere centre="0 0 20" radius="1"/></world><time step="1e-3" duration="1"/></scene>)";

// With a vertex more, a hexahedron is a polyhedron.
void make_polyhedron(Scene& scene) {
  ASSERT_TRUE(apply(rule("insert-vertex"), *scene.bodies()[0]->map, Dart{0u}).ok);
}

// Only the sheet of many cells has a picture. Its seam is the line x = 7: on each side of it u is another.
SkinPictures pictures_on(const Scene& scene) {
  SkinPictures all(scene.bodies().size() + 1);
  all[1].outside.picture = "some.png";
  all[1].lay = [map = scene.bodies()[1]->map.get()](std::span<const Dart> corners, bool,
                                                    std::vector<TexturePlace>& out) {
    double middle = 0;
    for (const Dart d : corners) middle += map->rest_of(d).x() - 7;
    for (const Dart d : corners)
      out.push_back({map->rest_of(d).x() / 16 + (middle > 0 ? 0.5 : 0), map->rest_of(d).y() / 4});
  };
  return all;
}

Vec3 point_of(const Grid& grid, std::int64_t p) {
  const double* x = grid.points.data() + 3 * p;
  return {x[0], x[1], x[2]};
}

// The faces of all polyhedra, as positions.
std::vector<std::vector<Vec3>> faces_of(const Grid& grid) {
  std::vector<std::vector<Vec3>> all;
  auto at = grid.faces.begin();
  while (at != grid.faces.end())
    for (auto faces = *at++; faces > 0; --faces) {
      all.emplace_back();
      for (auto corners = *at++; corners > 0; --corners) all.back().push_back(point_of(grid, *at++));
    }
  return all;
}

template <class T> const std::vector<T>& array_of(const Grid& grid, const std::string& name) {
  for (const GridArray& array : grid.on_points)
    if (array.name == name) return std::get<std::vector<T>>(array.values);
  throw std::invalid_argument(name);
}

TEST(Seams, of_a_grid_split_points_of_sheets_alone_and_leave_all_cells_where_they_are) {
  const auto scene = presets::load(scene_text);
  make_polyhedron(*scene.scene);
  const GridMaker maker(*scene.scene, pictures_on(*scene.scene));
  const Grid whole = maker.grid();
  Grid grid = whole;
  const std::vector<TexturePlace> places = split_at_seams(grid);
  ASSERT_EQ(3 * places.size(), grid.points.size());
  EXPECT_EQ(grid.points.size(), whole.points.size() + 3 * 4) << "four vertices lie on the seam";
  std::set<GridCell> kinds(grid.kinds.begin(), grid.kinds.end());
  EXPECT_EQ(kinds.count(GridCell::Polyhedron), 1U);
  EXPECT_EQ(kinds.size(), 7U) << "all but polygons";
  ASSERT_EQ(grid.corners.size(), whole.corners.size());
  for (std::size_t c = 0; c < grid.corners.size(); ++c) {
    ASSERT_EQ(point_of(grid, grid.corners[c]), point_of(whole, whole.corners[c]));
    ASSERT_EQ(places[static_cast<std::size_t>(grid.corners[c])], whole.texture[c]);
  }
  EXPECT_EQ(faces_of(grid), faces_of(whole));
  EXPECT_GT(faces_of(grid).size(), 5U);
}

TEST(Seams, of_a_grid_give_each_point_all_that_its_vertex_had) {
  const auto scene = presets::load(scene_text);
  for (int n = 0; n < 5; ++n) scene->step();
  make_polyhedron(*scene.scene);
  const GridMaker maker(*scene.scene, pictures_on(*scene.scene));
  const Grid whole = maker.grid();
  Grid grid = whole;
  const std::vector<TexturePlace> places = split_at_seams(grid);
  std::map<std::pair<std::int64_t, std::int64_t>, std::size_t> vertices; // body and slot → its point
  for (std::size_t p = 0; 3 * p < whole.points.size(); ++p)
    vertices[{array_of<std::int64_t>(whole, "body")[p], array_of<std::int64_t>(whole, "vertex")[p]}] = p;
  std::map<std::size_t, int> found; // points of each
  for (std::size_t p = 0; p < places.size(); ++p) {
    const auto& body = array_of<std::int64_t>(grid, "body");
    const std::size_t was = vertices.at({body[p], array_of<std::int64_t>(grid, "vertex")[p]});
    ++found[was];
    for (const char* name : {"rest", "velocity"})
      for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_EQ(array_of<double>(grid, name)[3 * p + axis], array_of<double>(whole, name)[3 * was + axis]);
    EXPECT_EQ(array_of<double>(grid, "mass")[p], array_of<double>(whole, "mass")[was]);
    if (body[p] != 1) {
      EXPECT_EQ(places[p], TexturePlace{}) << "the middle of the picture";
    }
  }
  EXPECT_EQ(found.size(), vertices.size());
  for (const auto& [was, count] : found)
    EXPECT_EQ(count, array_of<double>(whole, "rest")[3 * was] == 7 ? 2 : 1);
}

TEST(Seams, of_a_grid_are_none_where_no_sheet_has_a_picture) {
  const auto scene = presets::load(scene_text);
  EXPECT_TRUE(GridMaker(*scene.scene).grid().texture.empty());
  SkinPictures on_solid(scene->bodies().size() + 1);
  on_solid[0].outside.picture = on_solid[2].exposed.picture = "some.png";
  EXPECT_TRUE(GridMaker(*scene.scene, on_solid).grid().texture.empty());
}

} // namespace
} // namespace rend::seams_test
