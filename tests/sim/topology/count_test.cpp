#include "sim/topology/count.h"

#include "sim/topology/validate.h"
#include "tests/sim/assets.h"

#include <gtest/gtest.h>

namespace rend::count_test {
namespace {

void expect_cells(const EmbeddedMap& body, std::size_t vertices, std::size_t edges, std::size_t faces,
                  std::size_t volumes, std::size_t fragments, long euler) {
  const CellCounts counts = count_cells(body.map());
  EXPECT_EQ(counts.vertices, vertices);
  EXPECT_EQ(counts.edges, edges);
  EXPECT_EQ(counts.faces, faces);
  EXPECT_EQ(counts.volumes, volumes);
  EXPECT_EQ(counts.fragments, fragments);
  EXPECT_EQ(counts.euler, euler);
  EXPECT_FALSE(validate(body));
}

TEST(Counts, a_vertex_an_edge_and_a_face_grow_out_of_each_other) {
  EmbeddedMap body(2);
  const Dart d = apply(rule("create-vertex"), body).dart("a");
  EXPECT_EQ(count_cells(body.map(), Vertex), 1u);
  apply(rule("extrude-vertex"), body, d);
  EXPECT_EQ(count_cells(body.map(), Vertex), 2u);
  EXPECT_EQ(count_cells(body.map(), Edge), 1u);
  apply(rule("extrude-edge"), body, d);
  expect_cells(body, 4, 4, 1, 0, 1, 1);
}

TEST(Counts, a_quad_and_a_triangle_are_discs) {
  expect_cells(*assets::single_quad(), 4, 4, 1, 0, 1, 1);
  expect_cells(*assets::triangle(), 3, 3, 1, 0, 1, 1);
}

TEST(Counts, a_grid_is_a_disc) {
  expect_cells(*assets::grid(3, 2), 12, 17, 6, 0, 1, 1);
}

TEST(Counts, a_subdivided_quad_is_a_checkerboard) {
  expect_cells(*assets::checkerboard(3), 81, 144, 64, 0, 1, 1);
}

TEST(Counts, triangulation_adds_a_vertex_and_three_faces_a_quad) {
  expect_cells(*assets::triangulated_grid(3, 2), 12 + 6, 17 + 24, 24, 0, 1, 1);
}

TEST(Counts, a_loop_and_a_moebius_strip_have_no_euler_characteristic) {
  expect_cells(*assets::loop_of_quads(4, false), 8, 12, 4, 0, 1, 0);
  expect_cells(*assets::loop_of_quads(4, true), 8, 12, 4, 0, 1, 0);
}

TEST(Counts, a_loop_has_two_borders_and_a_moebius_strip_one) {
  const auto borders =
      // next dart along the border: α0, or around the vertex to the next free dart
      [](const EmbeddedMap& body) {
        const GMap& map = body.map();
        std::vector<char> met(map.capacity(), 0);
        int count = 0;
        map.for_each_dart([&](Dart first) {
          if (!map.is_free(2, first) || met[first.value]) return;
          ++count;
          for (Dart d = first; !met[d.value];) {
            met[d.value] = 1;
            d = map.alpha(0, d);
            met[d.value] = 1;
            d = map.alpha(1, d);
            while (!map.is_free(2, d)) d = map.alpha(1, map.alpha(2, d));
          }
        });
        return count;
      };
  EXPECT_EQ(borders(*assets::loop_of_quads(4, false)), 2);
  EXPECT_EQ(borders(*assets::loop_of_quads(4, true)), 1);
}

TEST(Counts, cubes_are_balls) {
  expect_cells(*assets::row_of_cubes(1), 8, 12, 6, 1, 1, 1);
  expect_cells(*assets::row_of_cubes(2), 12, 20, 11, 2, 1, 1);
}

TEST(Counts, fragments_are_numbered_by_their_smallest_dart) {
  EmbeddedMap body(2);
  const Dart first = assets::add_quad(body, 0, 0), second = assets::add_quad(body, 5, 0);
  const auto labels = label_fragments(body.map());
  EXPECT_EQ(labels[first.value], 0u);
  EXPECT_EQ(labels[second.value], 1u);
  apply(rule("remove-isolated-face"), body, first);
  const auto after = label_fragments(body.map());
  EXPECT_EQ(after[first.value], Dart::none_value);
  EXPECT_EQ(after[second.value], 0u);
}

} // namespace
} // namespace rend::count_test
