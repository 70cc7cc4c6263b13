// The exported surface: the same as in pictures, with vertices merged as in the map, oriented outward, at the
// positions of the state.
#include "sim/export/skin.h"

#include "sim/boundary/solid_surface.h"
#include "sim/boundary/surface.h"
#include "sim/presets.h"
#include "sim/topology/count.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <set>

namespace rend::skin_test {
namespace {

using Corner = std::array<double, 3>; // a position; unconnected bodies have no position in common here
using Side = std::pair<std::int32_t, std::int32_t>;

std::vector<std::int32_t> ring_of(const Skin& skin, std::size_t face) {
  const auto begin = face == 0 ? 0 : skin.ends[face - 1];
  return {skin.corners.begin() + begin, skin.corners.begin() + skin.ends[face]};
}

Vec3 point_of(const Skin& skin, std::int32_t p) {
  const double* x = skin.points.data() + 3 * p;
  return {x[0], x[1], x[2]};
}

// The number of traversals of each directed side.
std::map<Side, int> sides_of(const Skin& skin) {
  std::map<Side, int> all;
  for (std::size_t f = 0; f < skin.ends.size(); ++f) {
    const std::vector<std::int32_t> ring = ring_of(skin, f);
    for (std::size_t n = 0; n < ring.size(); ++n) ++all[{ring[n], ring[(n + 1) % ring.size()]}];
  }
  return all;
}

std::size_t open_sides(const Skin& skin) {
  const std::map<Side, int> sides = sides_of(skin);
  std::size_t open = 0;
  for (const auto& [side, count] : sides) {
    EXPECT_EQ(count, 1) << "two faces run the same way along a side";
    open += sides.count({side.second, side.first}) == 0;
  }
  return open;
}

// By cones over triangles of the faces [m³].
double volume_of(const Skin& skin) {
  double sixfold = 0;
  for (std::size_t f = 0; f < skin.ends.size(); ++f) {
    const std::vector<std::int32_t> ring = ring_of(skin, f);
    for (std::size_t n = 1; n + 1 < ring.size(); ++n)
      sixfold += point_of(skin, ring[0]).dot(point_of(skin, ring[n]).cross(point_of(skin, ring[n + 1])));
  }
  return sixfold / 6;
}

void expect_positions_of(const Skin& skin, const Scene& scene) {
  for (std::size_t p = 0; p < skin.vertex.size(); ++p) {
    const EmbeddedMap& map = *scene.bodies()[static_cast<std::size_t>(skin.body_of_point[p])]->map;
    const auto v = static_cast<Slot>(skin.vertex[p]);
    ASSERT_EQ(point_of(skin, static_cast<std::int32_t>(p)), map.position()[v].vec());
    for (int axis = 0; axis < 3; ++axis)
      ASSERT_EQ(skin.velocity[3 * p + static_cast<std::size_t>(axis)], map.velocity()[v].vec()[axis]);
  }
}

// Triangles as sets of vertex slots, independent of orientation and first corner.
using Triangles = std::multiset<std::set<Slot>>;

Triangles fans_of(const Skin& skin) {
  Triangles all;
  const auto slot = [&](std::int32_t p) { return static_cast<Slot>(skin.vertex[static_cast<std::size_t>(p)]); };
  for (std::size_t f = 0; f < skin.ends.size(); ++f) {
    const std::vector<std::int32_t> ring = ring_of(skin, f);
    for (std::size_t n = 1; n + 1 < ring.size(); ++n)
      all.insert({slot(ring[0]), slot(ring[n]), slot(ring[n + 1])});
  }
  return all;
}

template <class DrawnSurface> Triangles drawn(const DrawnSurface& surface) {
  Triangles all;
  surface.for_each_triangle([&](const auto& t) { all.insert({t.vertex[0], t.vertex[1], t.vertex[2]}); });
  return all;
}

TEST(Skin, of_a_torn_sheet_is_open_where_the_map_is) {
  for (const char* pattern : {"quads", "triangles", "crossed", "mixed"}) {
    const auto scene =
        presets::load(presets::cloth(pattern, 8, R"(<tear criterion="global-border" threshold="0.05"/>)"));
    const SkinMaker maker(*scene.scene);
    const std::size_t whole = open_sides(maker.skin());
    EXPECT_EQ(whole, 4u * 8);
    while (scene->steps_done() < 300) scene->step();
    ASSERT_GT(scene->tears(), 0u);
    const Skin skin = maker.skin();
    expect_positions_of(skin, *scene.scene);
    const GMap& map = scene.body().map->map();
    std::size_t free = 0; // both darts of a side
    map.for_each_dart([&](Dart d) { free += map.is_free(2, d); });
    EXPECT_EQ(open_sides(skin), free / 2) << pattern;
    EXPECT_EQ(open_sides(skin), whole + 2 * scene->tears()) << pattern;
    const CellCounts counts = count_cells(map);
    EXPECT_EQ(skin.vertex.size(), counts.vertices);
    EXPECT_EQ(skin.ends.size(), counts.faces);
    EXPECT_EQ(std::set<std::int32_t>(skin.fragment.begin(), skin.fragment.end()).size(), counts.fragments);
    EXPECT_EQ(fans_of(skin), drawn(Surface(*scene.body().map, scene.body().border)));
    EXPECT_TRUE(skin.exposed.empty());
    EXPECT_TRUE(skin.equivalent.empty());
  }
}

std::string bar(const std::string& pattern, const std::string& more) {
  return R"(<scene><body><bar pattern=")" + pattern +
         R"(" cells="4 2 2" size="0.8 0.2 0.1"/><place translate="1 2 3"/><mass density="1000"/>
         <elasticity young="1e5" poisson="0.3"/><fix side="-x"/>)" +
         more + R"(</body><time step="auto" duration="1"/></scene>)";
}

TEST(Skin, of_a_solid_is_closed_and_has_its_volume) {
  for (const char* pattern : {"hexahedra", "tetrahedra", "prisms", "mixed"}) {
    const auto scene = presets::load(bar(pattern, ""));
    const Skin skin = SkinMaker(*scene.scene).skin();
    EXPECT_EQ(open_sides(skin), 0u);
    EXPECT_NEAR(volume_of(skin), 0.016, 1e-13) << pattern;
    EXPECT_EQ(skin.vertex.size() + skin.ends.size(), sides_of(skin).size() / 2 + 2); // Euler: V + F = E + 2
    EXPECT_EQ(fans_of(skin), drawn(SolidSurface(*scene.body().map, scene.body().border)));
  }
}

TEST(Skin, of_a_solid_that_breaks_is_closed_around_every_part_and_knows_what_is_bare) {
  for (const char* pattern : {"hexahedra", "tetrahedra", "prisms", "mixed"}) {
    const auto scene = presets::load(bar(
        pattern, R"(<drive side="+x" velocity="2 0 0"/><tear criterion="vertex-stress" threshold="4e4"/>)"));
    const SkinMaker maker(*scene.scene);
    const std::vector<std::uint8_t> none = maker.skin().exposed;
    EXPECT_EQ(std::count(none.begin(), none.end(), 1), 0);
    while (scene->time() < 0.5) scene->step();
    const Skin skin = maker.skin();
    expect_positions_of(skin, *scene.scene);
    std::size_t exposed = 0, triangles = 0;
    const SolidSurface surface(*scene.body().map, scene.body().border);
    surface.for_each_triangle([&](const BoundaryTriangle& t) {
      exposed += t.exposed;
      ++triangles;
    });
    EXPECT_GT(exposed, 0u) << pattern;
    std::size_t marked = 0;
    for (std::size_t f = 0; f < skin.exposed.size(); ++f)
      marked += skin.exposed[f] * (ring_of(skin, f).size() - 2);
    EXPECT_EQ(marked, exposed);
    EXPECT_EQ(fans_of(skin), drawn(surface));
    const CellCounts counts = count_cells(scene.body().map->map());
    EXPECT_GT(counts.fragments, 1u) << pattern;
    EXPECT_EQ(std::set<std::int32_t>(skin.fragment.begin(), skin.fragment.end()).size(), counts.fragments);
    EXPECT_TRUE(std::is_sorted(skin.fragment.begin(), skin.fragment.end()));
    EXPECT_GT(*std::max_element(skin.equivalent.begin(), skin.equivalent.end()), 0);
  }
}

TEST(Skin, holds_several_bodies_one_after_another) {
  const auto scene = presets::load(R"(<scene>
    <body name="first"><sheet cells="2 1" size="2 1"/><mass total="1"/></body>
    <body name="second"><bar cells="1 1 1" size="1 1 1"/><mass density="1"/>
      <elasticity young="1e3" poisson="0.3"/></body>
    <time step="1e-3" duration="1"/></scene>)");
  const Skin skin = SkinMaker(*scene.scene).skin();
  EXPECT_EQ(skin.bodies, (std::vector<SkinOfBody>{{"first", false, 6, 2}, {"second", false, 14, 8}}));
  EXPECT_EQ(skin.body_of_face, (std::vector<std::int32_t>{0, 0, 1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(skin.fragment, skin.body_of_face);
  EXPECT_EQ(skin.equivalent.size(), 8u); // on the sheet, 0
  EXPECT_EQ(skin.largest_stress.size(), 14u);
  EXPECT_EQ(open_sides(skin), 6u);
}

TEST(Skin, of_a_band_with_one_side_has_all_its_faces) {
  const auto scene =
      presets::load(R"(<scene><body><sheet cells="20 2" size="3 0.3" close="twist"/><mass total="1"/>
    </body><time step="1" duration="1"/></scene>)");
  EXPECT_EQ(SkinMaker(*scene.scene).skin().ends.size(), 40u);
}

} // namespace
} // namespace rend::skin_test
