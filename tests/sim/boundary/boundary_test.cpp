// The owner of a body's boundary: its faces are those that a walk over the whole map finds, whatever was
// changed, and all who ask a body for it share it.
#include "sim/boundary/boundary.h"

#include "sim/fracture/torn_bodies.h"
#include "sim/mechanics/winding.h"

#include <gtest/gtest.h>
#include <tuple>

namespace rend::boundary_test {
namespace {

struct SeenFace {
  Dart first;
  bool turned, exposed;
  std::vector<Slot> vertices;
  bool operator==(const SeenFace&) const = default;
};

std::vector<SeenFace> faces_of(const Boundary& boundary) {
  std::vector<SeenFace> all;
  boundary.for_each_face([&](const BoundaryFaces::Face& face, std::span<const Slot> vertices) {
    EXPECT_EQ(face.sides, vertices.size());
    all.push_back({face.first, face.turned, face.exposed, {vertices.begin(), vertices.end()}});
  });
  return all;
}

// By a walk over all darts, each face from its smallest.
std::vector<SeenFace> walked(const Body& body) {
  const EmbeddedMap& map = *body.map;
  const GMap& links = map.map();
  const bool solid = map.dimension() == 3;
  std::vector<SeenFace> all;
  links.for_each_dart([&](Dart d) {
    if (smallest_dart(links, FaceOfVolume, d) != d || (solid && !links.is_free(3, d))) return;
    SeenFace face{
        d, solid && !winds_outward(map, d), solid && (*body.border)[map.slot(FaceOfVolume, d)] == 0, {}};
    const Dart start = face.turned ? links.alpha(1, d) : d;
    for (Dart at = start; at != start || face.vertices.empty(); at = links.follow(at, to_next_side))
      face.vertices.push_back(map.vertex(at));
    all.push_back(face);
  });
  return all;
}

TEST(Boundary, has_the_faces_that_a_walk_over_the_map_finds_whatever_tears) {
  for (auto& each : elements::irregular_maps()) {
    SCOPED_TRACE(each.name);
    const auto body =
        torn::body(std::move(each.map), {{"delete-element", Cell::Elements}, {"split-vertex", Cell::Vertices}});
    EXPECT_EQ(faces_of(body->boundary()), walked(*body));
    for (int n = 0; n < 8; ++n) {
      body->evaluate();
      body->tear(n, n, [] {});
      if (n % 3 == 2) body->map->renumber();
      body->rebind();
      EXPECT_EQ(faces_of(body->boundary()), walked(*body)) << n;
    }
  }
}

TEST(Boundary, is_shared_by_all_who_ask_a_body_and_says_when_it_changed) {
  for (auto& each : elements::irregular_maps()) {
    SCOPED_TRACE(each.name);
    const auto body = torn::body(std::move(each.map));
    Boundary& boundary = body->boundary();
    const long at_first = boundary.revision();
    EXPECT_EQ(&body->boundary(), &boundary);
    EXPECT_EQ(boundary.revision(), at_first);
    const int dimension = body->map->dimension();
    Dart inner; // where two elements meet
    body->map->map().for_each_dart([&](Dart d) {
      if (!inner && !body->map->map().is_free(dimension, d)) inner = d;
    });
    ASSERT_TRUE(inner);
    body->map->edit([&](Edit& edit) { unsew(edit, dimension, inner); });
    body->rebind();
    EXPECT_EQ(boundary.revision(), at_first) << "nobody asked since";
    EXPECT_GT(body->boundary().revision(), at_first);
    EXPECT_EQ(faces_of(boundary), walked(*body));
  }
}

TEST(Boundary, of_a_sheet_has_what_pictures_need_up_to_date_from_when_they_ask) {
  for (auto& each : elements::irregular_maps()) {
    if (each.map->dimension() == 3) continue;
    SCOPED_TRACE(each.name);
    const auto body = torn::body(std::move(each.map), {{"delete-element", Cell::Elements}});
    for (int n = 0; n < 4; ++n) {
      body->evaluate();
      body->tear(n, n, [] {});
      body->rebind();
      if (n > 0) {
        EXPECT_TRUE(body->boundary().sheet().same_as(Surface(*body->map, body->border))) << n;
      }
    }
  }
}

} // namespace
} // namespace rend::boundary_test
