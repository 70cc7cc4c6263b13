// Topological changes, against counts by hand and a reference on lists of elements.
#include "sim/fracture/torn_bodies.h"

#include <gtest/gtest.h>

#include <map>
#include <numeric>

namespace rend::change_test {
namespace {

using namespace torn;

std::unique_ptr<Body> quads(int nx, int ny, SheetClosure closure = SheetClosure::None) {
  return torn::body(sheet_from(meshes::sheet(SheetPattern::Quads, nx, ny, closure)));
}

bool separate_at(Body& body, const Vec3& place) {
  return make(body, "separate", Cell::Borders, {1, cell_at(body, Cell::Borders, place), {}});
}

TEST(Separate, of_one_edge_inside_a_sheet_splits_no_vertex_and_of_the_next_one) {
  const auto body = quads(4, 4);
  EXPECT_EQ(counts(*body), "25 40 16 0 in 1");
  EXPECT_TRUE(separate_at(*body, {2, 1.5, 0}));
  EXPECT_EQ(counts(*body), "25 41 16 0 in 1"); // a slit
  EXPECT_TRUE(separate_at(*body, {2, 2.5, 0}));
  EXPECT_EQ(counts(*body), "26 42 16 0 in 1"); // longer: its middle vertex splits
  EXPECT_TRUE(separate_at(*body, {2, 0.5, 0}));
  EXPECT_EQ(counts(*body), "28 43 16 0 in 1"); // up to the border: that vertex splits as well
  EXPECT_TRUE(separate_at(*body, {2, 3.5, 0}));
  EXPECT_EQ(counts(*body), "30 44 16 0 in 2");
  EXPECT_FALSE(separate_at(*body, {0, 0.5, 0})); // already a border
}

TEST(Separate, of_faces_isolates_a_hexahedron_of_a_block) {
  const auto body = block(3);
  EXPECT_EQ(counts(*body), "64 144 108 27 in 1");
  EXPECT_TRUE(separate_at(*body, {1.5, 1.5, 1}));
  EXPECT_EQ(counts(*body), "64 144 109 27 in 1"); // a slit between two hexahedra
  for (const Vec3& side : {Vec3(1.5, 1.5, 2), Vec3(1.5, 1, 1.5), Vec3(1.5, 2, 1.5), Vec3(1, 1.5, 1.5)})
    EXPECT_TRUE(separate_at(*body, side));
  EXPECT_TRUE(separate_at(*body, {2, 1.5, 1.5}));
  // Its 8 vertices, 12 edges and 6 faces are no longer shared.
  EXPECT_EQ(counts(*body), "72 156 114 27 in 2");
}

TEST(Separate, of_three_faces_isolates_the_corner_of_a_block) {
  const auto body = block(3);
  for (const Vec3& side : {Vec3(1, 0.5, 0.5), Vec3(0.5, 1, 0.5), Vec3(0.5, 0.5, 1)})
    EXPECT_TRUE(separate_at(*body, side));
  EXPECT_EQ(counts(*body), "71 153 111 27 in 2"); // all were shared but one vertex and three edges
}

TEST(DeleteElement, leaves_a_hole_in_a_block) {
  const auto body = block(3);
  const double mass = total_mass(*body->map, *body->mass);
  EXPECT_TRUE(
      make(*body, "delete-element", Cell::Elements, {1, cell_at(*body, Cell::Elements, {1.5, 1.5, 1.5}), {}}));
  EXPECT_EQ(counts(*body), "64 144 108 26 in 1");
  EXPECT_NEAR(total_mass(*body->map, *body->mass), mass * 26 / 27, 1e-9 * mass);
  const SolidSurface surface(*body->map, body->border);
  EXPECT_EQ(surface.faces(), 60u);
}

TEST(DeleteElement, of_one_face_of_a_sheet_leaves_a_hole) {
  const auto body = quads(3, 3);
  EXPECT_TRUE(
      make(*body, "delete-element", Cell::Elements, {1, cell_at(*body, Cell::Elements, {1.5, 1.5, 0}), {}}));
  EXPECT_EQ(counts(*body), "16 24 8 0 in 1");
  EXPECT_EQ(count_cells(body->map->map()).euler, 0);
}

TEST(DeleteEdge, deletes_all_that_hold_it) {
  const auto sheet = quads(3, 3);
  EXPECT_TRUE(make(*sheet, "delete-edge", Cell::Edges, {1, cell_at(*sheet, Cell::Edges, {1, 1.5, 0}), {}}));
  EXPECT_EQ(counts(*sheet), "16 22 7 0 in 1"); // the face, and a side that belongs to no other
  const auto solid = block(3);
  EXPECT_TRUE(make(*solid, "delete-edge", Cell::Edges, {1, cell_at(*solid, Cell::Edges, {1, 1, 1.5}), {}}));
  EXPECT_EQ(count_cells(solid->map->map()).volumes, 23u); // a hole of four cells
  EXPECT_TRUE(make(*solid, "delete-edge", Cell::Edges, {1, cell_at(*solid, Cell::Edges, {3, 3, 0.5}), {}}));
  EXPECT_EQ(count_cells(solid->map->map()).volumes, 22u); // in a ridge only one cell contains it
}

TEST(SplitVertex, on_an_edge_splits_the_other_end_where_one_cannot_be_split) {
  const auto body =
      torn::body(sheet_from(meshes::sheet(SheetPattern::Quads, 3, 4)), {{"split-vertex", Cell::Edges}});
  ASSERT_NE(body->corner_force.size(), 0u);
  // At the side of the sheet both faces are on one side of the plane: the vertex at the inner end is split,
  // along the edge.
  EXPECT_TRUE(make(*body, "split-vertex", Cell::Edges, {1, cell_at(*body, Cell::Edges, {0.5, 2, 0}), {}}));
  EXPECT_EQ(counts(*body), "21 33 12 0 in 1");
  EXPECT_EQ(body->map->cells(Vertex).count(), 21u);
}

// Σ over the corners, at that end, of the two faces at the edge.
double pull(const Body& body, Dart end, Dart other) {
  const GMap& map = body.map->map();
  const Vec3 along = (body.map->position_of(other) - body.map->position_of(end)).normalized();
  double sum = 0;
  for (Dart d : {end, map.alpha(2, end)})
    sum += std::abs(body.corner_force[body.map->slot(VertexOfFace, d)].vec().dot(along));
  return sum;
}

TEST(SplitVertex, on_an_edge_splits_the_end_that_is_pulled_more) {
  int firsts = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const auto body =
        torn::body(sheet_from(meshes::sheet(SheetPattern::Quads, 3, 4)), {{"split-vertex", Cell::Edges}});
    meshes::shake(*body, 0.1, seed);
    body->evaluate();
    const Dart d = cell_at(*body, Cell::Edges, {1.5, 2, 0}), e = body->map->map().alpha(0, d);
    const bool first = pull(*body, d, e) > pull(*body, e, d);
    firsts += first;
    const std::vector<Dart> around = darts_of(body->map->map(), Vertex, first ? d : e);
    EXPECT_TRUE(make(*body, "split-vertex", Cell::Edges, {1, d, {}}));
    std::set<Slot> fragments;
    for (Dart f : around) fragments.insert(body->map->vertex(f));
    EXPECT_EQ(fragments.size(), 2u);
  }
  EXPECT_GT(firsts, 0);
  EXPECT_LT(firsts, 20);
}

TEST(Separate, cuts_a_moebius_band_once_without_parting_it) {
  const auto body = quads(7, 1, SheetClosure::Twist);
  EXPECT_EQ(count_cells(body->map->map()).euler, 0);
  std::vector<Dart> across;
  body->map->map().for_each_dart([&](Dart d) {
    if (!body->map->map().is_free(2, d)) across.push_back(d);
  });
  EXPECT_TRUE(make(*body, "separate", Cell::Borders, {1, across.front(), {}}));
  EXPECT_EQ(counts(*body), "16 22 7 0 in 1");
  EXPECT_EQ(count_cells(body->map->map()).euler, 1); // a strip
}

// Elements as lists of points.
struct ElementLists {
  std::vector<Vec3> rest;
  std::vector<std::vector<std::uint32_t>> elements;
  int dimension;
};

ElementLists lists_of(const PolygonMesh& mesh) {
  ElementLists lists{mesh.points, {}, 2};
  for (std::size_t p = 0; p < mesh.polygons(); ++p)
    lists.elements.emplace_back(mesh.corners.begin() + mesh.first[p], mesh.corners.begin() + mesh.first[p + 1]);
  return lists;
}

ElementLists lists_of(const CellMesh& mesh) {
  ElementLists lists{mesh.points, {}, 3};
  for (std::size_t c = 0; c < mesh.cells(); ++c)
    lists.elements.emplace_back(mesh.corners_of(c).begin(), mesh.corners_of(c).end());
  return lists;
}

// Into how many fragments the plane splits a point: elements on one side are connected if they share a border.
int fragments_of(const ElementLists& lists, const std::vector<Vec3>& x, std::uint32_t point,
                 const Vec3& normal) {
  std::vector<std::size_t> at;
  std::vector<bool> above;
  for (std::size_t e = 0; e < lists.elements.size(); ++e) {
    const auto& corners = lists.elements[e];
    if (std::find(corners.begin(), corners.end(), point) == corners.end()) continue;
    Vec3 centre = Vec3::Zero();
    for (std::uint32_t c : corners) centre += x[c] / static_cast<double>(corners.size());
    at.push_back(e);
    above.push_back((centre - x[point]).dot(normal) >= 0);
  }
  std::vector<std::size_t> piece(at.size());
  std::iota(piece.begin(), piece.end(), 0u);
  const auto shared = [&](std::size_t a, std::size_t b) {
    std::set<std::uint32_t> of_a(lists.elements[a].begin(), lists.elements[a].end());
    return std::count_if(lists.elements[b].begin(), lists.elements[b].end(),
                         [&](std::uint32_t c) { return of_a.contains(c); });
  };
  for (std::size_t a = 0; a < at.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (above[a] == above[b] && shared(at[a], at[b]) >= lists.dimension) {
        const std::size_t from = piece[a], to = piece[b];
        std::replace(piece.begin(), piece.end(), from, to);
      }
  return static_cast<int>(std::set(piece.begin(), piece.end()).size());
}

void expect_splits_as_lists_say(const ElementLists& lists,
                                const std::function<std::unique_ptr<EmbeddedMap>()>& build) {
  Noise noise(17);
  int most = 0;
  for (int n = 0; n < 60; ++n) {
    const auto body = torn::body(build());
    const Dart d{noise.below(body->map->map().capacity())};
    std::vector<Vec3> x(lists.rest.size());
    std::uint32_t point = 0;
    for (Slot v = 0; v < body->vertices(); ++v)
      for (std::uint32_t p = 0; p < x.size(); ++p)
        if (body->map->rest()[v].vec() == lists.rest[p]) {
          x[p] = body->map->position()[v];
          if (v == body->map->vertex(d)) point = p;
        }
    const Vec3 normal = noise.vector().normalized();
    const std::vector<Dart> around = darts_of(body->map->map(), Vertex, d);
    const int expected = fragments_of(lists, x, point, normal);
    const bool made = make(*body, "split-vertex", Cell::Vertices, {1, d, normal});
    std::set<Slot> fragments;
    for (Dart e : around) fragments.insert(body->map->vertex(e));
    EXPECT_EQ(static_cast<int>(fragments.size()), expected);
    EXPECT_EQ(made, expected > 1);
    most = std::max(most, expected);
  }
  EXPECT_GT(most, 1);
}

TEST(SplitVertex, makes_of_every_vertex_of_sheets_as_many_fragments_as_lists_say) {
  for (const meshes::Named& each : meshes::irregular(0.15)) {
    SCOPED_TRACE(each.name);
    expect_splits_as_lists_say(lists_of(each.mesh), [&] { return sheet_from(each.mesh); });
  }
}

TEST(SplitVertex, makes_of_every_vertex_of_solids_as_many_fragments_as_lists_say) {
  for (BarPattern pattern : solids::all_patterns) {
    const CellMesh mesh = elements::warped_bar(pattern, pattern == BarPattern::Mixed ? 4 : 2, 2, 2, 0.08, 5);
    SCOPED_TRACE(static_cast<int>(pattern));
    expect_splits_as_lists_say(lists_of(mesh), [&] { return solid_from(mesh); });
  }
}

TEST(Change, that_parts_whole_elements_is_the_default_of_its_kind_of_cell) {
  std::set<Cell> cells;
  for (const ChangeType& type : all_changes()) {
    if (type.grows) continue; // asked for by its name alone
    EXPECT_TRUE(cells.insert(type.cell).second) << type.name;
    EXPECT_EQ(default_change(type.cell).name, type.name);
  }
  EXPECT_EQ(cells.size(), 4u);
}

} // namespace
} // namespace rend::change_test
