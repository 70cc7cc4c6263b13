// The surface of solids after edits, against the α3-free faces found by visiting every orbit, and against a
// surface built from scratch.
#include "sim/boundary/solid_surface.h"

#include "sim/assets.h"
#include "sim/boundary/solid_triangles.h"
#include "sim/boundary/solids.h"
#include "sim/random_meshes.h"

#include <gtest/gtest.h>
#include <map>
#include <set>

namespace rend::solid_edits_test {
namespace {

using namespace solids;
using meshes::Noise;

// Finds α3-free faces orbit by orbit, groups by union, neighbours by collecting orbits <2,3>.
class BruteForce {
public:
  explicit BruteForce(const Body& body, const std::set<Dart>& born_free) : body_(body), map_(body.map->map()) {
    map_.for_each_dart([&](Dart d) {
      if (map_.is_free(3, d) && smallest_dart(map_, FaceOfVolume, d) == d) faces_.push_back(d);
    });
    for (Dart first : faces_) {
      for (Dart d : darts_of(map_, FaceOfVolume, first)) parent_[d] = smallest_dart(map_, VertexOfFace, d);
      exposed_[first] = !born_free.contains(first);
    }
    for (const auto& each : std::map(parent_)) join_across(each.first);
  }

  const std::vector<Dart>& faces() const { return faces_; }
  bool exposed(Dart first) const { return exposed_.at(first); }

  // Twice the area vector at rest or now, pointing away from the cell's centre.
  Vec3 outward(Dart d, bool rest) const {
    const Vec3 middle = mean(Volume, d, rest), centre = mean(FaceOfVolume, d, rest);
    Vec3 sum = Vec3::Zero();
    Dart at = d;
    do {
      const Dart next = map_.alpha(1, map_.alpha(0, at));
      sum += (place(at, rest) - centre).cross(place(next, rest) - centre);
      at = next;
    } while (at != d);
    const Vec3 rest_side = rest ? sum : outward_sign(d) * sum;
    return rest && sum.dot(centre - middle) < 0 ? Vec3(-sum) : rest_side;
  }

  // Normals by the representative dart of their group.
  std::map<Dart, Vec3> normals() {
    std::map<Dart, Vec3> all;
    for (Dart first : faces_) {
      const double sign = outward_sign(first);
      std::set<Dart> done;
      for (Dart d : darts_of(map_, FaceOfVolume, first)) {
        const Dart corner = smallest_dart(map_, VertexOfFace, d);
        if (!done.insert(corner).second) continue;
        const bool along = steps_forward(first, corner);
        const Dart even = along ? corner : map_.alpha(1, corner), odd = map_.alpha(1, even);
        const Vec3 a = place(map_.alpha(0, even), false) - place(even, false),
                   b = place(map_.alpha(0, odd), false) - place(even, false);
        auto [at, added] = all.try_emplace(group(d), Vec3::Zero());
        at->second += sign * a.cross(b) / (a.squaredNorm() * b.squaredNorm());
      }
    }
    for (auto& [name, n] : all) n.normalize();
    return all;
  }

  Dart group(Dart d) {
    const Dart first = smallest_dart(map_, FaceOfVolume, d);
    if (exposed_.at(first)) return first;
    Dart at = parent_.at(d);
    while (parent_.at(at) != at) at = parent_.at(at);
    return at;
  }

  LineKind side(Dart d) const {
    const Dart other = neighbour(d);
    const Dart f = smallest_dart(map_, FaceOfVolume, d), g = smallest_dart(map_, FaceOfVolume, other);
    return exposed_.at(f) != exposed_.at(g) || angle(d, other) > 40 ? LineKind::Crease : LineKind::Cell;
  }

private:
  Vec3 place(Dart d, bool rest) const { return rest ? body_.map->rest_of(d) : body_.map->position_of(d); }
  Vec3 mean(Orbit orbit, Dart d, bool rest) const {
    Vec3 sum = Vec3::Zero();
    const auto darts = darts_of(map_, orbit, d);
    for (Dart e : darts) sum += place(e, rest);
    return sum / static_cast<double>(darts.size());
  }
  bool steps_forward(Dart from, Dart d) const {
    Dart at = from;
    do {
      if (at == d) return true;
      at = map_.alpha(1, map_.alpha(0, at));
    } while (at != from);
    return false;
  }
  // 1: the cycle from d through α0(d) is counter-clockwise seen from outside, at rest.
  double outward_sign(Dart d) const {
    const Vec3 middle = mean(Volume, d, true), centre = mean(FaceOfVolume, d, true);
    const Vec3 next = place(map_.alpha(0, d), true);
    return (place(d, true) - centre).cross(next - centre).dot(centre - middle) > 0 ? 1 : -1;
  }
  Dart neighbour(Dart d) const {
    Dart found = d;
    for (Dart e : darts_of(map_, EdgeEnd, d))
      if (e != d && map_.is_free(3, e)) found = e;
    return found;
  }
  double angle(Dart d, Dart e) const {
    const Vec3 a = outward(d, true), b = outward(e, true);
    return std::atan2(a.cross(b).norm(), a.dot(b)) * 57.29577951308232;
  }
  void join_across(Dart d) {
    const Dart other = neighbour(d);
    const Dart f = smallest_dart(map_, FaceOfVolume, d), g = smallest_dart(map_, FaceOfVolume, other);
    if (other == d || exposed_.at(f) || exposed_.at(g) || angle(d, other) > 40) return;
    const Dart a = group(d), b = group(other);
    parent_.at(std::max(a, b)) = std::min(a, b);
  }

  const Body& body_;
  const GMap& map_;
  std::vector<Dart> faces_;
  std::map<Dart, bool> exposed_;
  std::map<Dart, Dart> parent_;
};

std::set<Dart> free_faces(const GMap& map) {
  std::set<Dart> faces;
  map.for_each_dart([&](Dart d) {
    if (map.is_free(3, d)) faces.insert(smallest_dart(map, FaceOfVolume, d));
  });
  return faces;
}

void expect_equal(SolidSurface& surface, const Body& body, BruteForce&& brute) {
  const GMap& map = body.map->map();
  const auto normals = normals_of(surface);
  const auto expected = brute.normals();
  std::map<Dart, std::vector<BoundaryTriangle>> faces;
  for (const BoundaryTriangle& t : triangles_of(surface)) faces[t.first].push_back(t);
  ASSERT_EQ(faces.size(), brute.faces().size());
  for (Dart first : brute.faces()) {
    ASSERT_TRUE(faces.contains(first));
    Vec3 area = Vec3::Zero();
    std::map<std::pair<Slot, Slot>, LineKind> sides;
    std::map<Slot, Vec3> drawn;
    for (const BoundaryTriangle& t : faces[first]) {
      EXPECT_EQ(t.exposed, brute.exposed(first));
      area += 2 * area_vector(body, t);
      for (std::size_t k = 0; k < 3; ++k) {
        drawn[t.vertex[k]] = normals[t.normal[k]];
        if (t.side[k] != LineKind::Inner)
          sides[std::minmax(t.vertex[(k + 1) % 3], t.vertex[(k + 2) % 3])] = t.side[k];
      }
    }
    EXPECT_LT((area - brute.outward(first, false)).norm(), 1e-12);
    for (Dart d : darts_of(map, FaceOfVolume, first)) {
      const Slot a = body.map->vertex(d), b = body.map->vertex(map.alpha(0, d));
      ASSERT_TRUE(sides.contains(std::minmax(a, b)));
      EXPECT_EQ(sides.at(std::minmax(a, b)), brute.side(d));
      EXPECT_LT((drawn.at(a) - expected.at(brute.group(d))).norm(), 1e-9);
    }
  }
}

TEST(SolidSurface, equals_brute_force_and_a_new_one_along_storms_of_separations_and_their_undoing) {
  for (const Named& solid : all()) {
    SCOPED_TRACE(solid.name);
    const auto body = solids::body(solid.mesh);
    const std::set<Dart> born = free_faces(body->map->map());
    SolidSurface surface(*body->map, body->border);
    Noise noise(5);
    std::vector<std::pair<Dart, Dart>> open;
    for (int round = 0; round < 12; ++round) {
      body->map->edit([&](Edit& edit) {
        for (int n = 0; n < 3; ++n) {
          const Dart d{noise.below(edit.map().capacity())};
          if (noise.below(3) > 0 && edit.map().alive(d) && !edit.map().is_free(3, d)) {
            open.push_back({d, edit.map().alpha(3, d)});
            unsew(edit, 3, d);
          } else if (!open.empty() && n > 0) {
            const std::size_t at = noise.below(open.size());
            EXPECT_TRUE(sew(edit, 3, open[at].first, open[at].second));
            open.erase(open.begin() + static_cast<std::ptrdiff_t>(at));
          }
        }
      });
      for (Record& x : body->map->position().values()) x = Record(x.vec() + 0.01 * noise.vector());
      surface.update();
      ASSERT_TRUE(surface.same_as(SolidSurface(*body->map, body->border))) << round;
      EXPECT_TRUE(open_sides(surface).empty());
      expect_equal(surface, *body, BruteForce(*body, born));
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(SolidSurface, equals_a_new_one_along_storms_of_any_edit) {
  std::vector<Named> solids = all();
  solids.push_back({"warped hexahedra", bar(BarPattern::Hexahedra, 3, 3, 3)});
  Noise warp(2); // edges of all angles, non-planar faces
  for (Vec3& x : solids.back().mesh.points) x += 0.25 * warp.vector();
  for (const Named& solid : solids) {
    SCOPED_TRACE(solid.name);
    for (unsigned seed = 1; seed < 4; ++seed) {
      const auto body = solids::body(solid.mesh);
      SolidSurface surface(*body->map, body->border);
      Noise noise(seed);
      for (int round = 0; round < 30; ++round) {
        const auto any = [&] {
          for (;;)
            if (const Dart d{noise.below(body->map->map().capacity())}; body->map->map().alive(d)) return d;
        };
        for (int n = 0; n < 2; ++n) { // several edits before an update
          body->map->edit([&](Edit& edit) {
            for (int k = 0; k < 4; ++k) unsew(edit, 3, any());
            for (int k = 0; k < 60; ++k) sew(edit, 3, any(), any()); // also faces that were never neighbours
            if (round % 5 == 4 && count_cells(edit.map(), Volume) > 3) assets::remove_element(edit, any());
          });
          if (round % 3 == 1) apply(rule("star-face-both-sides"), *body->map, any());
          if (round % 7 == 5) apply(rule("insert-vertex"), *body->map, any());
          if (round % 11 == 6) body->map->edit([&](Edit& edit) { unsew(edit, 2, any()); });
        }
        surface.update();
        ASSERT_TRUE(surface.same_as(SolidSurface(*body->map, body->border)))
            << "seed " << seed << ", round " << round;
        for (const Vec3& n : normals_of(surface)) ASSERT_LT(std::abs(n.norm() - 0.5), 0.5 + 1e-12);
      }
    }
  }
}

void remove_cells(Body& body, std::initializer_list<std::uint32_t> cells) {
  body.map->edit([&](Edit& edit) {
    for (std::uint32_t cell : cells) assets::remove_element(edit, Dart{48 * cell});
  });
}

// Two holes that touch at a vertex of the solid: two fans of faces around it.
TEST(SolidSurface, of_a_vertex_with_two_fans_sees_both) {
  const auto body = solids::body(bar(BarPattern::Hexahedra, 2, 2, 2));
  const std::set<Dart> born = free_faces(body->map->map());
  SolidSurface surface(*body->map, body->border);
  remove_cells(*body, {0, 7});
  surface.update();
  EXPECT_TRUE(surface.same_as(SolidSurface(*body->map, body->border)));
  EXPECT_TRUE(open_sides(surface).empty());
  EXPECT_NEAR(volume_of(*body, surface), 6, 1e-12);
  std::set<Dart> in_the_middle;
  for (const BoundaryTriangle& t : triangles_of(surface))
    for (Slot v : t.vertex)
      if (place(*body, v) == Vec3(1, 1, 1)) in_the_middle.insert(t.first);
  EXPECT_EQ(in_the_middle.size(), 6u);
  expect_equal(surface, *body, BruteForce(*body, born));
}

// Two cells that share only the end points of an edge, between the same two layers: four faces there, in two
// pairs.
TEST(SolidSurface, of_an_edge_that_two_sheets_of_the_hull_touch_along_keeps_them_apart) {
  const auto body = solids::body(bar(BarPattern::Hexahedra, 2, 2, 3), false);
  SolidSurface surface(*body->map, body->border);
  remove_cells(*body, {5, 6});
  surface.update();
  EXPECT_TRUE(surface.same_as(SolidSurface(*body->map, body->border)));
  EXPECT_TRUE(open_sides(surface).empty());
  EXPECT_NEAR(volume_of(*body, surface), 10, 1e-12);
  std::size_t along = 0;
  for (const BoundaryTriangle& t : triangles_of(surface))
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 x = place(*body, t.vertex[k]), y = place(*body, t.vertex[(k + 1) % 3]);
      along +=
          x.head<2>() == Vec3(1, 1, 0).head<2>() && y.head<2>() == x.head<2>() && std::abs(x.z() - y.z()) == 1;
    }
  EXPECT_EQ(along, 4u);
}

} // namespace
} // namespace rend::solid_edits_test
