// What house rules make: counts of cells, and volumes that are kept.
#include "sim/house_rules/house_rules.h"

#include "sim/mesh/bar.h"
#include "sim/mesh/cells.h"
#include "sim/topology/isomorphism.h"
#include "sim/topology/orientation.h"
#include "tests/sim/assets.h"

#include <gtest/gtest.h>

#include <set>

namespace rend::house_rules_test {
namespace {

using assets::at;

std::vector<Dart> one_dart_each(const GMap& map, Orbit orbit) {
  std::vector<Dart> firsts;
  map.for_each_dart([&](Dart d) {
    if (smallest_dart(map, orbit, d) == d) firsts.push_back(d);
  });
  return firsts;
}

Vec3 mean(const EmbeddedMap& body, Orbit orbit, Dart d) {
  std::set<Slot> vertices;
  for (Dart e : darts_of(body.map(), orbit, d)) vertices.insert(body.vertex(e));
  Vec3 sum = Vec3::Zero();
  for (Slot v : vertices) sum += body.rest()[v].vec();
  return sum / static_cast<double>(vertices.size());
}

// The volume at rest of a cell with plane faces, as the sum of one tetrahedron a dart: vertex, edge, face,
// volume.
double volume(const EmbeddedMap& body, Dart cell) {
  const Vec3 centre = mean(body, Volume, cell);
  double sum = 0;
  for (Dart d : darts_of(body.map(), Volume, cell)) {
    const Vec3 a = body.rest_of(d) - centre, b = mean(body, EdgeOfFace, d) - centre,
               c = mean(body, FaceOfVolume, d) - centre;
    sum += std::abs(a.cross(b).dot(c)) / 6;
  }
  return sum;
}

double volume(const EmbeddedMap& body) {
  double sum = 0;
  for (Dart d : one_dart_each(body.map(), Volume)) sum += volume(body, d);
  return sum;
}

CellCounts after(const char* name, EmbeddedMap& body, const Hooks& hooks, const RuleArguments& arguments = {}) {
  const Applied done = apply(rule(name), body, hooks, arguments);
  EXPECT_TRUE(done.ok) << done.reason;
  const auto fault = validate(body);
  EXPECT_FALSE(fault) << fault.value_or("");
  return count_cells(body.map());
}

assets::Body prism() {
  auto body = std::make_unique<EmbeddedMap>(3);
  const Dart d =
      apply(rule("create-triangle"), *body, {}, assets::corners({at(0, 0), at(2, 0), at(0, 1)})).dart("a");
  after("extrude-face", *body, d, {{"v", vector_value(0.2, 0.1, 1.5)}});
  return body;
}

assets::Body tetrahedron() {
  auto body = std::make_unique<EmbeddedMap>(3);
  apply(rule("create-tetrahedron"), *body, {},
        assets::corners({at(0, 0), at(1, 0), at(0.2, 1.1), at(0.3, 0.1, 0.9)}));
  return body;
}

assets::Body bar(BarPattern pattern, int n) {
  return solid_from(bar_cells({pattern, n, n, n, Vec3(1, 1.5, 2)}));
}

struct Solid {
  const char* name;
  assets::Body (*make)();
};
const Solid solids[] = {{"cube", [] { return assets::row_of_cubes(1); }},
                        {"two cubes", [] { return assets::row_of_cubes(2); }},
                        {"prism", prism},
                        {"tetrahedron", tetrahedron},
                        {"tetrahedra", [] { return bar(BarPattern::Tetrahedra, 2); }},
                        {"prisms", [] { return bar(BarPattern::Prisms, 2); }},
                        {"mixed", [] { return bar(BarPattern::Mixed, 2); }}};

TEST(CreateTetrahedron, has_24_darts_and_can_be_sewn) {
  const auto body = tetrahedron();
  EXPECT_EQ(body->map().dart_count(), 24u);
  const CellCounts one = count_cells(body->map());
  EXPECT_EQ(one.vertices, 4u);
  EXPECT_EQ(one.edges, 6u);
  EXPECT_EQ(one.faces, 4u);
  EXPECT_EQ(one.volumes, 1u);
  EXPECT_TRUE(is_orientable(body->map()));
  const Dart other = apply(rule("create-tetrahedron"), *body).dart("a");
  const CellCounts two = after("sew-faces", *body, {Dart{0u}, other});
  EXPECT_EQ(two.vertices, 5u);
  EXPECT_EQ(two.edges, 9u);
  EXPECT_EQ(two.faces, 7u);
  EXPECT_EQ(two.volumes, 2u);
  EXPECT_EQ(two.fragments, 1u);
}

TEST(StarVolume, makes_a_pyramid_of_each_face) {
  for (const Solid& solid : solids) {
    SCOPED_TRACE(solid.name);
    const auto body = solid.make();
    const double whole = volume(*body);
    for (Dart d : one_dart_each(body->map(), Volume)) {
      const CellCounts before = count_cells(body->map());
      const std::size_t faces = [&] {
        std::set<std::uint32_t> found;
        for (Dart e : darts_of(body->map(), Volume, d))
          found.insert(smallest_dart(body->map(), FaceOfVolume, e).value);
        return found.size();
      }();
      const std::size_t corners = [&] {
        std::set<Slot> found;
        for (Dart e : darts_of(body->map(), Volume, d)) found.insert(body->vertex(e));
        return found.size();
      }();
      const double part = volume(*body, d);
      const Vec3 centre = mean(*body, Volume, d);
      const Applied done = apply(rule("star-volume"), *body, d);
      ASSERT_TRUE(done.ok) << done.reason;
      const CellCounts now = count_cells(body->map());
      EXPECT_EQ(now.volumes, before.volumes + faces - 1);
      EXPECT_EQ(now.vertices, before.vertices + 1);
      EXPECT_EQ(now.edges, before.edges + corners);
      EXPECT_EQ(now.euler, before.euler);
      EXPECT_LT((body->rest_of(done.dart("d")) - centre).norm(), 1e-14);
      double pyramids = 0;
      std::set<std::uint32_t> found;
      for (Dart e : darts_of(body->map(), Vertex, done.dart("d")))
        if (found.insert(smallest_dart(body->map(), Volume, e).value).second) pyramids += volume(*body, e);
      EXPECT_EQ(found.size(), faces);
      EXPECT_NEAR(pyramids, part, 1e-12 * part);
    }
    EXPECT_FALSE(validate(*body));
    EXPECT_NEAR(volume(*body), whole, 1e-12 * whole);
  }
}

TEST(DivideVolumes, makes_a_hexahedron_of_each_corner) {
  for (const Solid& solid : solids) {
    SCOPED_TRACE(solid.name);
    const auto body = solid.make();
    const double whole = volume(*body);
    const CellCounts before = count_cells(body->map());
    const std::size_t corners = count_cells(body->map(), VertexOfVolume);
    const CellCounts now = after("divide-volumes", *body, Dart{0u});
    EXPECT_EQ(now.volumes, corners); // 8 of a hexahedron, 6 of a prism, 4 of a tetrahedron
    EXPECT_EQ(now.vertices, before.vertices + before.edges + before.faces + before.volumes);
    EXPECT_EQ(now.euler, 1);
    EXPECT_NEAR(volume(*body), whole, 1e-12 * whole);
    for (Dart d : one_dart_each(body->map(), Volume)) {
      EXPECT_EQ(darts_of(body->map(), Volume, d).size(), 48u);
      EXPECT_EQ(sides_of_face(body->map(), d), 4);
    }
  }
}

TEST(DivideVolumes, twice_is_a_grid) {
  const auto body = assets::row_of_cubes(1),
             grid = solid_from(bar_cells({BarPattern::Hexahedra, 4, 4, 4, Vec3(1, 1, 1)}));
  after("divide-volumes", *body, Dart{0u});
  EXPECT_EQ(after("divide-volumes", *body, Dart{0u}).volumes, 64u);
  EXPECT_TRUE(isomorphism(body->map(), grid->map()));
}

TEST(HalveTetrahedra, halves_all_of_them_around_an_edge) {
  const auto body = bar(BarPattern::Tetrahedra, 2);
  const double whole = volume(*body);
  std::mt19937 random(1);
  for (int n = 0; n < 60; ++n) {
    const std::vector<Dart> darts = assets::all_darts(body->map());
    const Dart d = darts[random() % darts.size()];
    const std::vector<Dart> edge = darts_of(body->map(), Edge, d);
    std::set<std::uint32_t> around;
    for (Dart e : edge) around.insert(smallest_dart(body->map(), Volume, e).value);
    const CellCounts before = count_cells(body->map());
    const Vec3 middle = mean(*body, Edge, d);
    const Applied done = apply(rule("halve-tetrahedra"), *body, d);
    ASSERT_TRUE(done.ok) << done.reason;
    const auto fault = validate(*body);
    ASSERT_FALSE(fault) << fault.value_or("");
    const CellCounts now = count_cells(body->map());
    EXPECT_EQ(now.volumes, before.volumes + around.size());
    EXPECT_EQ(now.vertices, before.vertices + 1);
    EXPECT_EQ(now.euler, 1);
    EXPECT_LT((body->rest_of(done.dart("g")) - middle).norm(), 1e-14);
  }
  EXPECT_NEAR(volume(*body), whole, 1e-12 * whole);
  for (Dart d : one_dart_each(body->map(), Volume)) EXPECT_EQ(darts_of(body->map(), Volume, d).size(), 24u);
}

TEST(Sponge, keeps_20_of_27_of_the_volume_again_and_again) {
  const auto body = assets::row_of_cubes(1);
  double part = 1, volumes = 1;
  for (int n = 0; n < 2; ++n) {
    const CellCounts now = after("sponge", *body, Dart{0u});
    part *= 20.0 / 27;
    volumes *= 20;
    EXPECT_EQ(static_cast<double>(now.volumes), volumes);
    EXPECT_EQ(now.fragments, 1u);
    EXPECT_NEAR(volume(*body), part, 1e-12);
  }
  for (Dart d : one_dart_each(body->map(), Volume)) EXPECT_NEAR(volume(*body, d), 1.0 / 729, 1e-14);
  EXPECT_TRUE(is_orientable(body->map()));
}

// Thesis fig. 6.38.
TEST(Extrusion, sweeps_a_vertex_to_an_edge_a_face_a_volume_and_a_bar) {
  EmbeddedMap body(3);
  const Dart d = apply(rule("create-vertex"), body).dart("a");
  EXPECT_EQ(after("extrude-vertex", body, d, {{"v", vector_value(0, 1, 0)}}).edges, 1u);
  EXPECT_EQ(after("extrude-edge", body, d, {{"v", vector_value(0, 0, 1)}}).faces, 1u);
  Dart end = apply(rule("extrude-face"), body, d, {{"v", vector_value(1, 0, 0)}}).dart("f");
  EXPECT_EQ(count_cells(body.map()).volumes, 1u);
  for (int n = 0; n < 3; ++n)
    end = apply(rule("extrude-side"), body, end, {{"v", vector_value(1, 0, 0)}}).dart("f");
  ASSERT_FALSE(validate(body));
  const auto bar = solid_from(bar_cells({BarPattern::Hexahedra, 4, 1, 1, Vec3(4, 1, 1)}));
  EXPECT_EQ(count_cells(body.map()).volumes, 4u);
  EXPECT_NEAR(volume(body), 4, 1e-14);
  EXPECT_TRUE(isomorphism(body.map(), bar->map()));
}

TEST(Extrusion, of_a_border_adds_a_quad) {
  const auto body = assets::single_quad(), grid = assets::grid(2, 1);
  // The side from (1, 0) to (1, 1).
  after("extrude-border", *body, Dart{2u}, {{"v", vector_value(1, 0, 0)}});
  EXPECT_TRUE(isomorphism(body->map(), grid->map(),
                          [&](Dart a, Dart b) { return body->rest_of(a) == grid->rest_of(b); }));
}

TEST(QuarterFaces, of_a_moebius_band_is_one_again) {
  const auto body = assets::loop_of_quads(5, true);
  ASSERT_FALSE(is_orientable(body->map()));
  for (std::size_t faces : {20u, 80u}) {
    const CellCounts now = after("quarter-faces", *body, Dart{0u});
    EXPECT_EQ(now.faces, faces);
    EXPECT_EQ(now.euler, 0);
    EXPECT_EQ(now.fragments, 1u);
    EXPECT_FALSE(is_orientable(body->map()));
  }
}

TEST(InsertEdge, cuts_a_face_between_two_corners) {
  const auto body = assets::single_quad();
  const CellCounts now = after("insert-edge", *body, {Dart{0u}, Dart{3u}});
  EXPECT_EQ(now.faces, 2u);
  EXPECT_EQ(now.edges, 5u);
  EXPECT_EQ(now.vertices, 4u);
  for (Dart d : one_dart_each(body->map(), FaceOfVolume)) EXPECT_EQ(sides_of_face(body->map(), d), 3);
  EXPECT_TRUE(is_orientable(body->map()));
}

TEST(InsertEdge, cuts_both_sides_of_a_face_between_two_volumes) {
  const auto body = assets::row_of_cubes(2);
  Dart between;
  for (Dart d : assets::all_darts(body->map()))
    if (!body->map().is_free(3, d)) between = d;
  const Dart across = body->map().follow(between, std::string_view("010"));
  const CellCounts now = after("insert-edge", *body, {between, across});
  EXPECT_EQ(now.faces, 12u);
  EXPECT_EQ(now.edges, 21u);
  EXPECT_EQ(now.euler, 1);
}

TEST(HalveQuad, makes_two_triangles) {
  const auto body = assets::grid(2, 1);
  const CellCounts now = after("halve-quad", *body, Dart{0u});
  EXPECT_EQ(now.faces, 3u);
  EXPECT_EQ(now.edges, 8u);
  EXPECT_EQ(now.vertices, 6u);
  EXPECT_EQ(now.euler, 1);
  int triangles = 0;
  for (Dart d : one_dart_each(body->map(), FaceOfVolume)) triangles += sides_of_face(body->map(), d) == 3;
  EXPECT_EQ(triangles, 2);
  EXPECT_FALSE(apply(rule("halve-quad"), *assets::triangle(), Dart{0u}).ok);
}

TEST(Duplicate, makes_a_second_component_like_the_first) {
  for (const auto& make : {+[] { return assets::mixed_sheet(); }, +[] { return assets::row_of_cubes(2); },
                           +[] { return assets::loop_of_quads(5, true); }}) {
    const auto body = make(), one = make();
    const CellCounts before = count_cells(body->map());
    const CellCounts now = after("duplicate", *body, Dart{0u}, {{"v", vector_value(0, 0, 7)}});
    EXPECT_EQ(now.vertices, 2 * before.vertices);
    EXPECT_EQ(now.faces, 2 * before.faces);
    EXPECT_EQ(now.fragments, 2u);
    // Without the first one, the second is left, 7 m higher.
    body->edit([](Edit& edit) { remove_orbit(edit, Component, Dart{0u}); });
    EXPECT_TRUE(isomorphism(body->map(), one->map(), [&](Dart a, Dart b) {
      return body->rest_of(a) == one->rest_of(b) + Vec3(0, 0, 7);
    }));
  }
}

TEST(Move, moves_one_vertex) {
  const auto body = assets::grid(2, 2), before = assets::grid(2, 2);
  const auto links = assets::links(body->map());
  const Dart d{3u};
  after("move", *body, d, {{"v", vector_value(0.1, 0.2, 0.3)}});
  EXPECT_EQ(assets::links(body->map()), links);
  body->map().for_each_dart([&](Dart e) {
    const Vec3 by = body->vertex(e) == body->vertex(d) ? Vec3(0.1, 0.2, 0.3) : Vec3(0, 0, 0);
    EXPECT_EQ(body->position_of(e), before->position_of(e) + by);
    EXPECT_EQ(body->rest_of(e), before->rest_of(e) + by);
  });
}

TEST(Remove, an_isolated_volume) {
  const auto body = assets::row_of_cubes(2);
  EXPECT_FALSE(apply(rule("remove-isolated-volume"), *body, Dart{0u}).ok);
  Dart between;
  for (Dart d : assets::all_darts(body->map()))
    if (!body->map().is_free(3, d)) between = d;
  after("unsew-face", *body, between);
  EXPECT_EQ(after("remove-isolated-volume", *body, Dart{0u}).volumes, 1u);
}

} // namespace
} // namespace rend::house_rules_test
