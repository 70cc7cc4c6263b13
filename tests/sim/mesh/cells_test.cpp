// Solids from cells: each dart against the list of corners of its cell, α3 against brute force, volumes against
// closed forms.
#include "sim/mesh/cells.h"

#include "sim/mechanics/mass.h"
#include "sim/mesh/bar.h"
#include "sim/mesh/fault.h"
#include "sim/mesh/tube.h"
#include "sim/topology/count.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <set>

namespace rend::cells_test {
namespace {

using testing::HasSubstr;

constexpr std::array<CellKind, 4> all_kinds{CellKind::Tetrahedron, CellKind::Hexahedron, CellKind::Prism,
                                            CellKind::Pyramid};

// One cell with the corners of the unit cube, in Gmsh's order.
CellMesh unit(CellKind kind) {
  CellMesh mesh;
  const auto point = [&](double x, double y, double z) { mesh.points.emplace_back(x, y, z); };
  switch (kind) {
  case CellKind::Tetrahedron:
    point(0, 0, 0), point(1, 0, 0), point(0, 1, 0), point(0, 0, 1);
    mesh.add(kind, {0, 1, 2, 3});
    break;
  case CellKind::Hexahedron:
    for (double z : {0., 1.}) point(0, 0, z), point(1, 0, z), point(1, 1, z), point(0, 1, z);
    mesh.add(kind, {0, 1, 2, 3, 4, 5, 6, 7});
    break;
  case CellKind::Prism:
    for (double z : {0., 1.}) point(0, 0, z), point(1, 0, z), point(0, 1, z);
    mesh.add(kind, {0, 1, 2, 3, 4, 5});
    break;
  case CellKind::Pyramid:
    point(0, 0, 0), point(1, 0, 0), point(1, 1, 0), point(0, 1, 0), point(0.5, 0.5, 1);
    mesh.add(kind, {0, 1, 2, 3, 4});
    break;
  }
  return mesh;
}

double unit_volume(CellKind kind) {
  return std::array<double, 4>{1. / 6, 1, 0.5, 1. / 3}[static_cast<std::size_t>(kind)];
}

CellMesh bar(BarPattern pattern, int nx, int ny, int nz, const Vec3& size = Vec3(1, 1, 1)) {
  return bar_cells({pattern, nx, ny, nz, size});
}

constexpr std::array<BarPattern, 4> all_patterns{BarPattern::Hexahedra, BarPattern::Tetrahedra,
                                                 BarPattern::Prisms, BarPattern::Mixed};

std::string refusal_of(const CellMesh& mesh) {
  try {
    solid_from(mesh);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "not refused";
}

std::size_t open_faces(const GMap& map) {
  std::size_t open = 0;
  map.for_each_dart([&](Dart d) {
    if (!map.is_free(3, d)) return;
    Dart smallest = d, at = d;
    do {
      smallest = std::min({smallest, at, map.alpha(0, at)});
      at = map.alpha(1, map.alpha(0, at));
    } while (at != d);
    open += smallest == d;
  });
  return open;
}

TEST(Cells, of_each_kind_have_their_corners_edges_and_faces) {
  const std::map<CellKind, std::array<std::size_t, 3>> counts{{CellKind::Tetrahedron, {4, 6, 4}},
                                                              {CellKind::Hexahedron, {8, 12, 6}},
                                                              {CellKind::Prism, {6, 9, 5}},
                                                              {CellKind::Pyramid, {5, 8, 5}}};
  for (const CellKind kind : all_kinds) {
    SCOPED_TRACE(shape_of(kind).name);
    const auto map = solid_from(unit(kind));
    ASSERT_EQ(validate(*map), std::nullopt);
    const CellCounts c = count_cells(map->map());
    EXPECT_EQ((std::array{c.vertices, c.edges, c.faces}), counts.at(kind));
    EXPECT_EQ(c.volumes, 1u);
    EXPECT_EQ(c.euler, 1);
    EXPECT_EQ(map->map().dart_count(), 4 * c.edges);
    EXPECT_EQ(corners_of_volume(map->map(), Dart{5u}), shape_of(kind).corners);
  }
}

// The order of an element's corners (cell_shapes.h; thesis 5.2.4, fig. 5.22).
TEST(Cells, lead_from_their_first_dart_to_their_corners_by_words) {
  using Words = std::vector<std::string>;
  const std::map<CellKind, Words> words{
      {CellKind::Tetrahedron, {"", "0", "10", "210"}},
      {CellKind::Hexahedron, {"", "0", "010", "10", "210", "0210", "010210", "10210"}},
      {CellKind::Prism, {"", "0", "10", "210", "0210", "10210"}},
      {CellKind::Pyramid, {"", "0", "010", "10", "210"}}};
  for (const CellKind kind : all_kinds) {
    const CellMesh mesh = unit(kind);
    const auto map = solid_from(mesh);
    const Words& each = words.at(kind);
    for (std::size_t n = 0; n < each.size(); ++n) {
      const Dart d = map->map().follow(Dart{0u}, each[n]);
      EXPECT_EQ(map->rest_of(d), mesh.points[n]) << shape_of(kind).name << " corner " << n;
    }
  }
}

TEST(Cells, have_the_volume_of_the_closed_form_under_any_affine_map) {
  std::mt19937 random(7);
  const auto number = [&] { return static_cast<double>(random() % 2001) / 1000 - 1; };
  for (const CellKind kind : all_kinds)
    for (int n = 0; n < 20; ++n) {
      CellMesh mesh = unit(kind);
      Eigen::Matrix3d a;
      for (int i = 0; i < 9; ++i) a(i) = number();
      if (std::abs(a.determinant()) < 0.01) continue;
      for (Vec3& x : mesh.points) x = (a * x + Vec3(3, -2, 1)).eval();
      const double expected = a.determinant() * unit_volume(kind);
      EXPECT_NEAR(signed_volume(mesh, 0), expected, 1e-14);
      const SewnSolid solid = sew_cells(mesh);
      EXPECT_EQ(solid.turned, expected < 0 ? 1u : 0u);
      EXPECT_EQ(validate(*solid.map), std::nullopt);
      EXPECT_NEAR(rest_volume(*solid.map, Dart{0u}), std::abs(expected), 1e-14);
      // reversed or not, the first corners form a right-handed frame
      const auto at = [&](const char* word) {
        return solid.map->rest_of(solid.map->map().follow(Dart{0u}, std::string(word)));
      };
      EXPECT_GT((at("0") - at("")).cross(at("10") - at("")).dot(at("210") - at("")), 0);
    }
}

// Every permutation of corners that is a symmetry of the cell gives the same cell.
TEST(Cells, that_are_inside_out_are_turned_and_still_match_their_neighbours) {
  for (const BarPattern pattern : all_patterns) {
    CellMesh mesh = bar(pattern, 3, 2, 2);
    std::size_t turned = 0;
    for (std::size_t c = 0; c < mesh.cells(); c += 3, ++turned)
      for (const auto& [a, b] : shape_of(mesh.kinds[c]).mirror)
        std::swap(mesh.corners[mesh.first[c] + static_cast<std::size_t>(a)],
                  mesh.corners[mesh.first[c] + static_cast<std::size_t>(b)]);
    const SewnSolid solid = sew_cells(mesh);
    EXPECT_EQ(solid.turned, turned);
    EXPECT_EQ(validate(*solid.map), std::nullopt);
    EXPECT_EQ(count_cells(solid.map->map()).euler, 1);
    EXPECT_EQ(solid.map->cells(Vertex).count(), mesh.points.size());
  }
}

TEST(Cells, are_sewn_exactly_where_two_share_all_points_of_a_face) {
  for (const BarPattern pattern : all_patterns) {
    const CellMesh mesh = bar(pattern, 4, 3, 2);
    const auto map = solid_from(mesh);
    std::map<std::set<std::uint32_t>, int> faces;
    for (std::size_t c = 0; c < mesh.cells(); ++c) {
      const CellShape& shape = shape_of(mesh.kinds[c]);
      for (std::size_t f = 0; f < static_cast<std::size_t>(shape.faces); ++f) {
        std::set<std::uint32_t> points;
        for (int s = 0; s < shape.sides[f]; ++s)
          points.insert(
              mesh.corners_of(c)[static_cast<std::size_t>(shape.ring[f][static_cast<std::size_t>(s)])]);
        ++faces[points];
      }
    }
    std::size_t open = 0;
    for (const auto& [points, times] : faces) open += times == 1;
    EXPECT_EQ(open_faces(map->map()), open);
    EXPECT_EQ(count_cells(map->map(), Face), faces.size());
    map->map().for_each_dart([&](Dart d) { EXPECT_EQ(map->rest_of(d), map->rest_of(map->map().alpha(3, d))); });
  }
}

TEST(Cells, remember_the_point_of_each_vertex) {
  const CellMesh mesh = bar(BarPattern::Mixed, 3, 2, 1);
  const SewnSolid solid = sew_cells(mesh);
  ASSERT_EQ(solid.point.size(), solid.map->cells(Vertex).slots());
  for (Slot v = 0; v < solid.point.size(); ++v)
    EXPECT_EQ(solid.map->rest()[v].vec(), mesh.points[solid.point[v]]);
}

TEST(Cells, take_few_bytes_a_dart) { // 64 is the limit, for map and embeddings
  for (const BarPattern pattern : all_patterns) {
    const auto map = solid_from(bar(pattern, 10, 10, 10));
    map->add(CornerMass{.density = 1}.on(*map));
    EXPECT_LT(static_cast<double>(map->map().bytes() + map->bytes()),
              32.0 * static_cast<double>(map->map().dart_count()));
  }
}

TEST(Cells, that_meet_only_in_a_point_or_an_edge_have_vertices_of_their_own) {
  CellMesh mesh;
  for (int z = 0; z < 3; ++z)
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 3; ++x) mesh.points.emplace_back(x, y, z);
  const auto cube = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    const std::uint32_t o = x + 3 * y + 9 * z;
    mesh.add(CellKind::Hexahedron, {o, o + 1, o + 4, o + 3, o + 9, o + 10, o + 13, o + 12});
  };
  cube(0, 0, 0), cube(1, 1, 0),
      cube(0, 0, 1); // the second shares an edge with the first, a point with the third
  const auto map = solid_from(mesh);
  EXPECT_EQ(validate(*map), std::nullopt);
  const CellCounts counts = count_cells(map->map());
  EXPECT_EQ(counts.fragments, 2u);
  EXPECT_EQ(counts.vertices, 12u + 8u);
  EXPECT_EQ(counts.euler, 2);
}

TEST(Cells, are_refused_where_a_solid_cannot_hold_them) {
  CellMesh mesh = unit(CellKind::Tetrahedron); // three tetrahedra at one triangle
  mesh.points.emplace_back(0, 0, -1);
  mesh.points.emplace_back(0.1, 0.1, 2);
  mesh.add(CellKind::Tetrahedron, {0, 1, 2, 4});
  mesh.add(CellKind::Tetrahedron, {2, 1, 0, 5});
  EXPECT_THAT(refusal_of(mesh),
              HasSubstr("tetrahedron 2: shares the face with the points 0 1 2 with more than one other"));

  CellMesh flat = unit(CellKind::Tetrahedron);
  flat.points[3] = Vec3(0.3, 0.3, 0);
  EXPECT_THAT(refusal_of(flat), HasSubstr("tetrahedron 0: has no volume"));
  flat.points[3].z() = 1e-13;
  EXPECT_THAT(refusal_of(flat), HasSubstr("is too long and thin to compute with: 1.67e-14 m3 at a length "
                                          "of 1 m"));
  flat.points[3].z() = 1e200;
  EXPECT_THAT(refusal_of(flat), HasSubstr("has too large a length or volume for a number of 64 bits"));
  flat.points[3].z() = 1e-9; // thin, but valid
  EXPECT_THAT(refusal_of(flat), HasSubstr("not refused"));
  flat.points[3].z() = std::nan("");
  EXPECT_THAT(refusal_of(flat), HasSubstr("not finite"));

  CellMesh again = unit(CellKind::Tetrahedron); // a duplicate, and a cell on the same side of a face
  again.add(CellKind::Tetrahedron, {1, 0, 2, 3});
  EXPECT_THAT(refusal_of(again), HasSubstr("tetrahedron 1: overlaps tetrahedron 0"));
  again.points.emplace_back(0.1, 0.2, 3);
  again.corners.back() = 4;
  EXPECT_THAT(refusal_of(again), HasSubstr("both lie on the same side of the face with the points 0 1 2"));

  CellMesh twice = unit(CellKind::Prism);
  twice.corners[5] = 2;
  EXPECT_THAT(refusal_of(twice), HasSubstr("prism 0: meets point 2 twice"));
  CellMesh beyond = unit(CellKind::Pyramid);
  beyond.corners[4] = 5;
  EXPECT_THAT(refusal_of(beyond), HasSubstr("pyramid 0: has a corner 5, and there are 5 points"));
}

TEST(Cells, are_refused_where_faces_lie_on_each_other_and_do_not_match) {
  for (const bool other_diagonal : {false, true}) { // two tetrahedra on top of a cube
    CellMesh mesh = unit(CellKind::Hexahedron);
    mesh.points.emplace_back(0.5, 0.5, 2);
    if (other_diagonal) {
      mesh.add(CellKind::Tetrahedron, {4, 5, 7, 8});
      mesh.add(CellKind::Tetrahedron, {5, 6, 7, 8});
    } else {
      mesh.add(CellKind::Tetrahedron, {4, 5, 6, 8});
      mesh.add(CellKind::Tetrahedron, {4, 6, 7, 8});
    }
    EXPECT_THAT(refusal_of(mesh),
                HasSubstr("hexahedron 0: has a face with the points 4 5 6 7, on which tetrahedron"));
  }
  CellMesh crossed = unit(CellKind::Hexahedron); // a pyramid whose base connects the cube's points diagonally
  crossed.points[5].z() = 1.5;                   // if it were flat, it would have no volume
  crossed.points.emplace_back(0.2, 0.6, 3);
  crossed.add(CellKind::Pyramid, {4, 6, 5, 7, 8});
  EXPECT_THAT(refusal_of(crossed), HasSubstr("they do not match"));
}

TEST(Bar, is_a_ball_of_the_right_volume_in_every_pattern) {
  const std::map<BarPattern, std::array<std::size_t, 4>> cells{// tetrahedra, hexahedra, prisms, pyramids
                                                               {BarPattern::Hexahedra, {0, 60, 0, 0}},
                                                               {BarPattern::Tetrahedra, {360, 0, 0, 0}},
                                                               {BarPattern::Prisms, {0, 0, 120, 0}},
                                                               {BarPattern::Mixed, {96, 24, 48, 24}}};
  for (const BarPattern pattern : all_patterns) {
    const CellMesh mesh = bar(pattern, 5, 4, 3, Vec3(2, 1, 0.5));
    std::array<std::size_t, 4> found{};
    for (const CellKind kind : mesh.kinds) ++found[static_cast<std::size_t>(kind)];
    EXPECT_EQ(found, cells.at(pattern));
    const SewnSolid solid = sew_cells(mesh);
    EXPECT_EQ(solid.turned, 0u);
    ASSERT_EQ(validate(*solid.map), std::nullopt);
    const CellCounts counts = count_cells(solid.map->map());
    EXPECT_EQ(counts.euler, 1);
    EXPECT_EQ(counts.fragments, 1u);
    EXPECT_EQ(counts.vertices, mesh.points.size());
    double volume = 0;
    for (std::size_t c = 0; c < mesh.cells(); ++c) volume += signed_volume(mesh, c);
    EXPECT_NEAR(volume, 1, 1e-14);
    const std::size_t quads =
        2 * (5 * 4 + 5 * 3 + 4 * 3); // faces of boxes on the surface: no inner face is open
    const std::size_t open = open_faces(solid.map->map());
    const std::map<BarPattern, std::size_t> expected{{BarPattern::Hexahedra, quads},
                                                     {BarPattern::Tetrahedra, 2 * quads},
                                                     {BarPattern::Prisms, quads + 2 * 5 * 4},
                                                     // ends of prisms; sides of the slice that is split into
                                                     // tetrahedra
                                                     {BarPattern::Mixed, quads + 2 * (2 * 4 + 4 + 3)}};
    EXPECT_EQ(open, expected.at(pattern));
  }
}

TEST(Tube, of_fig_7_14_is_a_ring_of_32_hexahedra) {
  for (const auto& [around, along] : {std::pair{8, 4}, {4, 8}, {16, 2}}) {
    const TubeShape shape{around, along, Vec3(1, 0.8, 3), 0.15};
    const CellMesh mesh = tube_cells(shape);
    EXPECT_EQ(mesh.cells(), 32u);
    const SewnSolid solid = sew_cells(mesh);
    EXPECT_EQ(solid.turned, 0u);
    ASSERT_EQ(validate(*solid.map), std::nullopt);
    const CellCounts counts = count_cells(solid.map->map());
    EXPECT_EQ(counts.euler, 0); // a solid torus
    EXPECT_EQ(counts.fragments, 1u);
    double volume = 0;
    for (std::size_t c = 0; c < mesh.cells(); ++c) volume += signed_volume(mesh, c);
    EXPECT_NEAR(volume, 3 * (1 * 0.8 - 0.7 * 0.5), 1e-14);
  }
}

} // namespace
} // namespace rend::cells_test
