#include "sim/mesh/locality.h"

#include "sim/mesh/bar.h"
#include "sim/mesh/fault.h"
#include "sim/mesh/sheet.h"
#include "sim/topology/walk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <random>
#include <set>

namespace rend::locality_test {
namespace {

std::vector<std::uint32_t> shuffled(std::size_t count) {
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0U);
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  return order;
}

// The mean over cells of the range of their vertices' slots.
double spread_of_slots(const EmbeddedMap& map) {
  double sum = 0;
  const CellIndex cells(map.map(), map.dimension() == 3 ? Volume : FaceOfVolume);
  for (Slot c = 0; c < cells.slots(); ++c) {
    Slot low = no_slot, high = 0;
    for (const Dart d : darts_of(map.map(), cells.orbit(), cells.first_dart(c))) {
      low = std::min(low, map.vertex(d));
      high = std::max(high, map.vertex(d));
    }
    sum += high - low;
  }
  return sum / static_cast<double>(cells.slots());
}

TEST(Locality, a_mesh_that_was_made_in_order_keeps_it) {
  for (const BarPattern pattern : {BarPattern::Hexahedra, BarPattern::Tetrahedra, BarPattern::Mixed})
    EXPECT_TRUE(order_for_locality(bar_cells({pattern, 21, 21, 21, Vec3(1, 1, 1)})).empty());
}

TEST(Locality, few_elements_stay_where_they_are) {
  const CellMesh mesh = bar_cells({BarPattern::Tetrahedra, 8, 8, 8, Vec3(1, 1, 1)});
  EXPECT_TRUE(order_for_locality(reordered(mesh, shuffled(mesh.cells()))).empty());
}

TEST(Locality, a_shuffled_solid_comes_as_near_together_as_one_made_in_order) {
  const CellMesh made = bar_cells({BarPattern::Tetrahedra, 21, 21, 21, Vec3(1, 1, 1)});
  const CellMesh mixed_up = reordered(made, shuffled(made.cells()));
  const std::vector<std::uint32_t> order = order_for_locality(mixed_up);
  EXPECT_EQ(std::set<std::uint32_t>(order.begin(), order.end()).size(), made.cells());
  const double good = spread_of_slots(*solid_from(made)), bad = spread_of_slots(*solid_from(mixed_up)),
               mended = spread_of_slots(*solid_from(reordered(mixed_up, order)));
  EXPECT_GT(bad, 5 * good);
  EXPECT_LT(mended, 1.5 * good);
}

TEST(Locality, what_cannot_be_sewn_is_left_to_who_says_so) {
  CellMesh mesh = bar_cells({BarPattern::Hexahedra, 21, 21, 21, Vec3(1, 1, 1)});
  mesh = reordered(mesh, shuffled(mesh.cells()));
  mesh.points[7].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(order_for_locality(mesh).empty());
  mesh.points[7].x() = 0;
  mesh.corners[100] = 4000000;
  EXPECT_TRUE(order_for_locality(mesh).empty());
}

TEST(Locality, corners_keep_their_texture_coordinates) {
  SheetShape shape;
  shape.nx = shape.ny = 100;
  shape.size = {1, 1};
  PolygonMesh mesh = sheet_polygons(shape);
  for (const std::uint32_t c : mesh.corners) mesh.texture.push_back({mesh.points[c].x(), -mesh.points[c].y()});
  mesh = reordered(mesh, shuffled(mesh.polygons()));
  const std::vector<std::uint32_t> order = order_for_locality(mesh);
  ASSERT_FALSE(order.empty());
  const auto map = sheet_from(reordered(mesh, order));
  const auto& places = *find_texture_coordinates(*map);
  map->map().for_each_dart([&](Dart d) {
    const Vec3 x = map->rest_of(d);
    ASSERT_EQ(places[map->slot(VertexOfFace, d)], (TexturePlace{x.x(), -x.y()}));
  });
}

// A duplicate cell: the message must use the number in the file.
TEST(Locality, messages_name_cells_as_before) {
  CellMesh mesh = bar_cells({BarPattern::Hexahedra, 2, 1, 1, Vec3(2, 1, 1)});
  const auto corners = mesh.corners_of(1);
  const std::vector<std::uint32_t> again(corners.begin(), corners.end());
  mesh.add(CellKind::Hexahedron, again);
  const CellMesh other = reordered(mesh, {2, 0, 1});
  EXPECT_EQ(other.cell_name(0), 2U);
  try {
    sew_cells(other);
    FAIL() << "it was sewn";
  } catch (const MeshFault& fault) {
    EXPECT_EQ(fault.element, 2U);
    EXPECT_NE(fault.flaw.find("overlaps hexahedron 2"), std::string::npos) << fault.flaw;
  }
}

// Slices of 6 x 7 points, one after another along the longest side: a box uses points of two of them, both of
// which the first boxes visit at once, and the previous slice may have visited some of them.
TEST(Locality, of_a_long_bar_goes_slice_by_slice) {
  for (const std::array<int, 3>& n : {std::array{300, 5, 6}, {5, 300, 6}, {6, 5, 300}}) {
    const CellMesh mesh = bar_cells({BarPattern::Hexahedra, n[0], n[1], n[2], Vec3(n[0], n[1], n[2])});
    ASSERT_EQ(mesh.cells(), 300u * 5 * 6);
    std::vector<int> met(mesh.points.size(), -1);
    int next = 0, farthest = 0;
    std::set<std::array<int, 3>> places;
    for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
      int low = next, high = 0;
      Vec3 sum = Vec3::Zero();
      for (const std::uint32_t point : mesh.corners_of(cell)) {
        if (met[point] < 0) met[point] = next++;
        low = std::min(low, met[point]);
        high = std::max(high, met[point]);
        sum += mesh.points[point];
      }
      farthest = std::max(farthest, high - low);
      places.insert(
          {static_cast<int>(sum.x() / 8), static_cast<int>(sum.y() / 8), static_cast<int>(sum.z() / 8)});
    }
    EXPECT_EQ(places.size(), mesh.cells());
    EXPECT_LE(farthest, 3 * 6 * 7);
  }
}

} // namespace
} // namespace rend::locality_test
