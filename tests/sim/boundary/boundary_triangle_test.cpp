// The triangles of sheets and solids through random tears and rules: their darts against the orbits of the map,
// and their fans against the sides of faces, found by visiting every dart.
#include "sim/boundary/boundary_triangle.h"

#include "sim/assets.h"
#include "sim/boundary/boundary.h"
#include "sim/boundary/solids.h"
#include "sim/contact/contact_faces.h"
#include "sim/random_meshes.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace rend::boundary_triangle_test {
namespace {

using meshes::Noise;

using Steps = std::map<std::pair<Dart, Dart>, int>; // from corner to corner, and how often

struct Seen { // of one face
  std::set<std::uint32_t> numbers;
  Steps steps; // along the sides of its triangles
};
using Faces = std::map<Dart, Seen>; // by the smallest dart of each

struct Counts {
  std::size_t triangles = 0, exposed = 0, turned = 0, changes = 0;
};

// What stands for the corner of a face at d.
Dart corner(const GMap& map, Dart d) {
  return smallest_dart(map, VertexOfFace, d);
}

// Each dart belongs to the vertex and the face of its triangle, and starts the side to the next corner.
Faces faces_of(const EmbeddedMap& map, Boundary& boundary, Counts& counts) {
  const GMap& links = map.map();
  Faces faces;
  boundary.for_each_triangle([&](const BoundaryTriangle& triangle) {
    ++counts.triangles;
    counts.exposed += triangle.exposed;
    counts.turned += triangle.turned;
    Seen& face = faces[triangle.first];
    EXPECT_TRUE(face.numbers.insert(triangle.number).second);
    EXPECT_EQ(smallest_dart(links, FaceOfVolume, triangle.first), triangle.first);
    const std::array<Dart, 3> darts = corner_darts(links, triangle);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(map.vertex(darts[k]), triangle.vertex[k]);
      EXPECT_TRUE(same_cell(links, FaceOfVolume, darts[k], triangle.first));
      const Dart from = darts[(k + 1) % 3], to = corner(links, darts[(k + 2) % 3]);
      ++face.steps[{corner(links, from), to}];
      const bool is_side = corner(links, links.alpha(0, from)) == to;
      EXPECT_EQ(is_side, triangle.side[k] != LineKind::Inner);
    }
  });
  return faces;
}

// Each of its sides is that of one triangle, the others are those of two that go there and back: so the
// triangles cover it once.
void expect_covered(const GMap& map, Dart first, Seen face) {
  const auto sides = static_cast<std::size_t>(sides_of_face(map, first));
  EXPECT_EQ(face.numbers.size(), sides - 2);
  EXPECT_EQ(*face.numbers.rbegin(), sides - 3);
  std::size_t found = 0;
  for (const Dart d : darts_of(map, FaceOfVolume, first)) {
    const Dart other = map.alpha(0, d);
    if (d > other) continue;
    const auto there = face.steps.extract({corner(map, d), corner(map, other)});
    const auto back = face.steps.extract({corner(map, other), corner(map, d)});
    ASSERT_NE(there.empty(), back.empty());
    EXPECT_EQ((there.empty() ? back : there).mapped(), 1);
    ++found;
  }
  EXPECT_EQ(found, sides);
  for (const auto& [step, count] : face.steps) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(face.steps.contains({step.second, step.first}));
  }
}

// How often a face goes from one vertex to another, less how often it comes back; by slots of faces.
using Net = std::map<Slot, std::map<std::pair<Slot, Slot>, int>>;
void add_triangle(Net& net, Slot face, const std::array<Slot, 3>& vertex) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Slot a = vertex[k], b = vertex[(k + 1) % 3];
    int& count = net[face][std::minmax(a, b)];
    count += a < b ? 1 : -1;
  }
}

// Contact divides faces along other diagonals, but all of each, and in the same sense.
void expect_same_in_contact(EmbeddedMap& map, Boundary& boundary) {
  const ContactFaces contact(map, boundary);
  Net drawn, touched;
  boundary.for_each_triangle([&](const BoundaryTriangle& triangle) {
    add_triangle(drawn, map.slot(FaceOfVolume, triangle.first), triangle.vertex);
  });
  for (const ContactFaces::Triangle& triangle : contact.triangles())
    add_triangle(touched, triangle.face, triangle.vertex);
  for (Net* net : {&drawn, &touched})
    for (auto& [face, steps] : *net) std::erase_if(steps, [](const auto& step) { return step.second == 0; });
  EXPECT_EQ(drawn, touched);
}

void expect_all(EmbeddedMap& map, Boundary& boundary, Counts& counts) {
  const GMap& links = map.map();
  boundary.update();
  const Faces faces = faces_of(map, boundary, counts);
  std::size_t outside = 0;
  links.for_each_dart([&](Dart d) {
    if (!links.is_free(3, d) || smallest_dart(links, FaceOfVolume, d) != d) return;
    ++outside;
    const auto seen = faces.find(d);
    ASSERT_NE(seen, faces.end()) << "the face of dart " << d.value << " is not drawn";
    expect_covered(links, d, seen->second);
  });
  EXPECT_EQ(faces.size(), outside);
  expect_same_in_contact(map, boundary);
}

Dart any_dart(const GMap& map, Noise& noise) {
  const std::vector<Dart> all = assets::all_darts(map);
  return all[noise.below(all.size())];
}

void tear(EmbeddedMap& map, Noise& noise) {
  map.edit([&](Edit& edit) {
    for (int n = 0; n < 3; ++n) unsew(edit, map.dimension(), any_dart(edit.map(), noise));
  });
}

TEST(BoundaryTriangle, of_sheets_that_tear_has_darts_of_its_vertices_and_covers_its_face_once) {
  Counts counts;
  unsigned seed = 0;
  for (const meshes::Named& sheet : meshes::irregular()) {
    SCOPED_TRACE(sheet.name);
    const auto map = sheet_from(sheet.mesh);
    Boundary boundary(*map, nullptr);
    Noise noise(++seed);
    expect_all(*map, boundary, counts);
    for (int n = 0; n < 20 && !testing::Test::HasFailure(); ++n) {
      tear(*map, noise);
      if (n % 2 == 0) counts.changes += apply(rule("insert-vertex"), *map, any_dart(map->map(), noise)).ok;
      if (n % 5 == 4) map->edit([&](Edit& edit) { assets::remove_element(edit, any_dart(edit.map(), noise)); });
      expect_all(*map, boundary, counts);
    }
  }
  EXPECT_GT(counts.triangles, 9000U);
  EXPECT_GT(counts.changes, 70U);
  EXPECT_EQ(counts.exposed, 0U);
}

// The darts that start a side of a face, as triangles have them.
std::set<Dart> starts_of_sides(const GMap& map, Boundary& boundary) {
  std::set<Dart> all;
  boundary.for_each_triangle([&](const BoundaryTriangle& triangle) {
    const std::array<Dart, 3> darts = corner_darts(map, triangle);
    all.insert(darts.begin(), darts.end());
  });
  return all;
}

// Rules make faces whose smallest dart shows the back.
TEST(BoundaryTriangle, of_a_sheet_whose_faces_hand_on_their_fronts_goes_around_the_front) {
  Counts counts;
  for (unsigned seed = 1; seed < 7; ++seed) {
    const auto map = sheet_from(meshes::warped(meshes::sheet(SheetPattern::Triangles, 4, 3), 0.1, seed));
    map->add(FaceSense{});
    Boundary boundary(*map, nullptr);
    Noise noise(seed);
    for (int n = 0; n < 40 && !testing::Test::HasFailure(); ++n) {
      const Dart d = any_dart(map->map(), noise);
      if (n % 4 == 3) tear(*map, noise);
      if (n % 4 == 1) counts.changes += apply(rule("halve-triangles"), *map, d).ok;
      counts.changes += apply(rule("divide-edge-of-triangles"), *map, d, {{"share", scalar_value(0.4)}}).ok;
      expect_all(*map, boundary, counts);
      const std::set<Dart> starts = starts_of_sides(map->map(), boundary);
      for (const Dart start : starts) { // neighbours run against each other along their common side
        const GMap& links = map->map();
        EXPECT_FALSE(starts.contains(links.alpha(0, start)));
        if (!links.is_free(2, start)) {
          EXPECT_TRUE(starts.contains(links.alpha(0, links.alpha(2, start))));
        }
      }
    }
  }
  EXPECT_GT(counts.changes, 100U);
  EXPECT_GT(counts.turned, 1000U);
}

TEST(BoundaryTriangle, of_solids_that_break_has_darts_of_its_vertices_and_covers_its_face_once) {
  Counts counts;
  unsigned seed = 0;
  for (const solids::Named& solid : solids::all()) {
    SCOPED_TRACE(solid.name);
    const auto body = solids::body(solid.mesh);
    Boundary boundary(*body->map, body->border);
    Noise noise(++seed);
    expect_all(*body->map, boundary, counts);
    for (int n = 0; n < 10 && !testing::Test::HasFailure(); ++n) {
      tear(*body->map, noise);
      if (n % 3 == 2)
        body->map->edit([&](Edit& edit) { assets::remove_element(edit, any_dart(edit.map(), noise)); });
      if (n % 3 == 1) {
        const Dart d = any_dart(body->map->map(), noise);
        counts.changes += apply(rule("insert-vertex"), *body->map, d).ok;
      }
      expect_all(*body->map, boundary, counts);
    }
  }
  EXPECT_GT(counts.triangles, 8000U);
  EXPECT_GT(counts.exposed, 1000U);
  EXPECT_GT(counts.turned, 1000U);
  EXPECT_GT(counts.changes, 10U);
}

TEST(BoundaryTriangle, has_the_lines_of_its_face_alone) {
  using enum LineKind;
  const auto kinds = [](std::uint32_t k) { return std::array{Border, Cell, Torn, Cell, Crease}[k]; };
  EXPECT_EQ(fan_size(5), 3U);
  EXPECT_EQ(fan_lines(0, 5, kinds), (std::array{Cell, Inner, Border}));
  EXPECT_EQ(fan_lines(1, 5, kinds), (std::array{Torn, Inner, Inner}));
  EXPECT_EQ(fan_lines(2, 5, kinds), (std::array{Cell, Crease, Inner}));
  EXPECT_EQ(fan_lines(0, 3, kinds), (std::array{Cell, Torn, Border}));
  for (const std::uint32_t sides : {0U, 1U, 2U}) EXPECT_EQ(fan_size(sides), 0U);
}

} // namespace
} // namespace rend::boundary_triangle_test
