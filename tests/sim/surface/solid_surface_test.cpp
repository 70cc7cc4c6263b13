// The surface of solids, against their cells as plain lists and against the α3-free faces found orbit by orbit.
#include "sim/surface/solid_surface.h"

#include "sim/assets.h"
#include "sim/random_meshes.h"
#include "sim/surface/solids.h"

#include <gtest/gtest.h>
#include <map>
#include <numeric>
#include <set>

namespace rend {
namespace {

using namespace solids;
using meshes::Noise;
using Triangle = SolidSurface::Triangle;

std::vector<Triangle> triangles_of(const SolidSurface& surface) {
  std::vector<Triangle> all;
  surface.for_each_triangle([&](const Triangle& t) { all.push_back(t); });
  return all;
}

std::vector<Vec3> normals_of(SolidSurface& surface) {
  std::vector<Vec3> normals;
  surface.normals(normals);
  return normals;
}

Vec3 place(const Body& body, Slot v) {
  return body.map->position()[v].vec();
}

Vec3 area_vector(const Body& body, const Triangle& t) {
  const Vec3 a = place(body, t.vertex[0]);
  return 0.5 * (place(body, t.vertex[1]) - a).cross(place(body, t.vertex[2]) - a);
}

// Of what the triangles enclose.
double volume_of(const Body& body, const SolidSurface& surface) {
  double sum = 0;
  for (const Triangle& t : triangles_of(surface)) sum += place(body, t.vertex[0]).dot(area_vector(body, t)) / 3;
  return sum;
}

// How often each directed side of a triangle occurs, less how often its opposite does: nothing remains of what is closed.
std::map<std::pair<Slot, Slot>, int> open_sides(const SolidSurface& surface) {
  std::map<std::pair<Slot, Slot>, int> count;
  for (const Triangle& t : triangles_of(surface))
    for (std::size_t k = 0; k < 3; ++k) {
      const Slot a = t.vertex[k], b = t.vertex[(k + 1) % 3];
      if (a < b)
        ++count[{a, b}];
      else
        --count[{b, a}];
    }
  std::erase_if(count, [](const auto& side) { return side.second == 0; });
  return count;
}

// Faces of single cells, by their sorted points.
std::multiset<std::vector<std::uint32_t>> faces_of_one_cell(const CellMesh& mesh) {
  constexpr std::array<const char*, 4> faces{"012 013 023 123", "0123 4567 0145 1256 2367 3047",
                                             "012 345 0143 1254 2035", "0123 014 124 234 304"};
  std::map<std::vector<std::uint32_t>, int> count;
  for (std::size_t c = 0; c < mesh.cells(); ++c) {
    std::vector<std::uint32_t> face;
    for (const char* at = faces[static_cast<std::size_t>(mesh.kinds[c])];; ++at) {
      if (*at != ' ' && *at != 0) {
        face.push_back(mesh.corners_of(c)[static_cast<std::size_t>(*at - '0')]);
        continue;
      }
      std::sort(face.begin(), face.end());
      ++count[face];
      face.clear();
      if (*at == 0) break;
    }
  }
  std::multiset<std::vector<std::uint32_t>> alone;
  for (const auto& [face, n] : count)
    if (n == 1) alone.insert(face);
  return alone;
}

TEST(SolidSurface, draws_the_faces_that_only_one_cell_has) {
  for (const Named& solid : all()) {
    SCOPED_TRACE(solid.name);
    SewnSolid sewn = sew_cells(solid.mesh);
    const std::vector<std::uint32_t> point = sewn.point;
    const auto body = solids::body(std::move(sewn.map));
    const SolidSurface surface(*body);
    std::map<Dart, std::set<std::uint32_t>> faces;
    for (const Triangle& t : triangles_of(surface))
      for (Slot v : t.vertex) faces[t.first].insert(point[v]);
    std::multiset<std::vector<std::uint32_t>> drawn;
    for (const auto& [first, points] : faces) drawn.insert({points.begin(), points.end()});
    EXPECT_EQ(drawn, faces_of_one_cell(solid.mesh));
    EXPECT_EQ(surface.faces(), drawn.size());
  }
}

TEST(SolidSurface, is_closed_and_encloses_the_volume_of_the_cells) {
  for (const Named& solid : all()) {
    SCOPED_TRACE(solid.name);
    const auto body = solids::body(solid.mesh);
    const SolidSurface surface(*body);
    EXPECT_TRUE(open_sides(surface).empty());
    double expected = 0;
    for (std::size_t c = 0; c < solid.mesh.cells(); ++c) expected += signed_volume(solid.mesh, c);
    EXPECT_NEAR(volume_of(*body, surface), expected, 1e-12);
  }
}

TEST(SolidSurface, of_a_ball_has_the_euler_characteristic_of_a_sphere_and_of_a_tube_that_of_a_torus) {
  for (const Named& solid : all()) {
    SCOPED_TRACE(solid.name);
    const auto body = solids::body(solid.mesh);
    std::set<Slot> vertices;
    std::map<std::pair<Slot, Slot>, int> edges;
    const auto triangles = triangles_of(SolidSurface(*body));
    for (const Triangle& t : triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        vertices.insert(t.vertex[k]);
        ++edges[std::minmax(t.vertex[k], t.vertex[(k + 1) % 3])];
      }
    for (const auto& [ends, count] : edges) EXPECT_EQ(count, 2);
    const auto euler = static_cast<long>(vertices.size()) - static_cast<long>(edges.size()) +
                       static_cast<long>(triangles.size());
    EXPECT_EQ(euler, solid.name == "tube" ? 0 : 2);
  }
}

TEST(SolidSurface, faces_outward_however_the_darts_are_numbered) {
  for (BarPattern pattern : all_patterns) {
    const auto body = solids::body(bar(pattern, 4, 3, 2));
    SolidSurface surface(*body);
    const auto normals = normals_of(surface);
    for (const Triangle& t : triangles_of(surface)) {
      const Vec3 out = (place(*body, t.vertex[0]) + place(*body, t.vertex[1]) + place(*body, t.vertex[2])) / 3 -
                       Vec3(2, 1.5, 1);
      EXPECT_GT(area_vector(*body, t).dot(out), 0);
      for (std::uint32_t c : t.corner) EXPECT_GT(normals[c].dot(out), 0);
    }
  }
  const auto row = solids::body(assets::row_of_cubes(3)); // by hand
  EXPECT_NEAR(volume_of(*row, SolidSurface(*row)), 3, 1e-12);
}

TEST(SolidSurface, of_a_bar_has_sharp_edges_between_flat_sides) {
  for (BarPattern pattern : all_patterns) {
    const auto body = solids::body(bar(pattern, 4, 2, 2));
    SolidSurface surface(*body);
    const auto normals = normals_of(surface);
    for (const Triangle& t : triangles_of(surface)) {
      const Vec3 flat = area_vector(*body, t).normalized();
      EXPECT_NEAR(flat.cwiseAbs().maxCoeff(), 1, 1e-12); // along an axis
      for (std::uint32_t c : t.corner) EXPECT_NEAR((normals[c] - flat).norm(), 0, 1e-12);
      for (std::size_t k = 0; k < 3; ++k) {
        if (t.side[k] == Side::Inner) continue;
        const Vec3 x = place(*body, t.vertex[(k + 1) % 3]), y = place(*body, t.vertex[(k + 2) % 3]);
        int planes = 0; // sides of the bar that the edge lies in
        for (int axis = 0; axis < 3; ++axis)
          planes += x[axis] == y[axis] && (x[axis] == 0 || x[axis] == (axis == 0 ? 4 : 2));
        EXPECT_EQ(t.side[k], planes == 2 ? Side::Crease : Side::Cell);
      }
    }
  }
}

TEST(SolidSurface, of_a_ball_is_smooth) {
  for (BarPattern pattern : all_patterns) {
    const auto body = solids::body(ball(pattern, 8));
    SolidSurface surface(*body);
    const auto normals = normals_of(surface);
    double worst = 1;
    for (const Triangle& t : triangles_of(surface))
      for (std::size_t k = 0; k < 3; ++k) {
        worst = std::min(worst, normals[t.corner[k]].dot(place(*body, t.vertex[k]).normalized()));
        EXPECT_NE(t.side[k], Side::Crease);
      }
    EXPECT_GT(worst, std::cos(0.07)) << static_cast<int>(pattern); // 4°
  }
}

TEST(SolidSurface, turns_and_bends_its_normals_with_the_body_but_keeps_its_creases) {
  const auto body = solids::body(bar(BarPattern::Hexahedra, 12, 2, 2));
  SolidSurface surface(*body);
  for (Record& x : body->map->position().values()) { // a quarter of a ring of radius 8 in the middle
    const double angle = x.vec().x() / 8, r = 7 + x.vec().z();
    x = Record(Vec3(r * std::sin(angle), x.vec().y(), r * std::cos(angle)));
  }
  const auto normals = normals_of(surface);
  for (const Triangle& t : triangles_of(surface))
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 rest = body->map->rest()[t.vertex[k]].vec();
      const double angle = rest.x() / 8;
      const Vec3 along(std::cos(angle), 0, -std::sin(angle)), up(std::sin(angle), 0, std::cos(angle));
      const Vec3 n = normals[t.corner[k]];
      const double best = std::max(
          {std::abs(n.dot(along)), std::abs(n.dot(up)), std::abs(n.y())}); // along one of the turned axes
      EXPECT_GT(best, std::cos(0.07));
    }
}

TEST(SolidSurface, of_a_collapsed_solid_has_no_normals_and_no_nan) {
  const auto body = solids::body(bar(BarPattern::Mixed, 3, 1, 1));
  for (Record& x : body->map->position().values()) x = Record(1, 2, 3);
  SolidSurface surface(*body);
  for (const Vec3& n : normals_of(surface)) EXPECT_EQ(n, Vec3::Zero());
}

TEST(SolidSurface, marks_what_is_laid_bare_around_a_cell_cut_free_and_keeps_it_flat) {
  const auto body = solids::body(bar(BarPattern::Hexahedra, 3, 3, 3));
  SolidSurface surface(*body);
  const Dart middle{13u * 48};
  body->map->edit([&](Edit& edit) {
    for (Dart d : darts_of(edit.map(), Volume, middle)) unsew(edit, 3, d);
  });
  surface.update();
  EXPECT_TRUE(surface.same_as(SolidSurface(*body)));
  EXPECT_EQ(surface.faces(), 54u + 12);
  EXPECT_TRUE(open_sides(surface).empty());
  EXPECT_NEAR(volume_of(*body, surface), 27, 1e-12);
  const auto normals = normals_of(surface);
  std::set<Dart> bare;
  for (const Triangle& t : triangles_of(surface)) {
    if (t.bare) bare.insert(t.first);
    for (std::uint32_t c : t.corner)
      EXPECT_NEAR((normals[c] - area_vector(*body, t).normalized()).norm(), 0, 1e-12);
  }
  EXPECT_EQ(bare.size(), 12u);
  body->map->edit([&](Edit& edit) { remove_element(edit, middle); });
  surface.update();
  EXPECT_EQ(surface.faces(), 54u + 6);
  EXPECT_NEAR(volume_of(*body, surface), 26, 1e-12);
}

TEST(SolidSurface, keeps_the_hull_smooth_and_the_bare_faces_flat_on_a_warped_solid) {
  CellMesh mesh = ball(BarPattern::Hexahedra, 6);
  const auto body = solids::body(mesh);
  SolidSurface surface(*body);
  body->map->edit([&](Edit& edit) { // all that is sewn through the middle
    for (std::uint32_t d = 0; d < edit.map().capacity(); ++d) {
      double most = 0;
      for (Dart e : darts_of(edit.map(), FaceOfVolume, Dart{d}))
        most = std::max(most, std::abs(body->map->rest_of(e).x()));
      if (most < 1e-12) unsew(edit, 3, Dart{d});
    }
  });
  surface.update();
  const auto normals = normals_of(surface);
  std::size_t bare = 0;
  for (const Triangle& t : triangles_of(surface))
    for (std::size_t k = 0; k < 3; ++k) {
      bare += t.bare;
      const Vec3 expected =
          t.bare ? area_vector(*body, t).normalized() : place(*body, t.vertex[k]).normalized();
      // Next to the cut a hull corner sees its own side alone, which is a chord's tilt.
      EXPECT_GT(normals[t.corner[k]].dot(expected), t.bare ? 1 - 1e-12 : std::cos(0.25));
    }
  EXPECT_EQ(bare, 2u * 36 * 2 * 3);
}

TEST(SolidSurface, marks_nothing_bare_where_nothing_may_tear) {
  const auto body = solids::body(bar(BarPattern::Mixed, 3, 2, 2), false);
  SolidSurface surface(*body);
  body->map->edit([&](Edit& edit) {
    for (std::uint32_t d = 0; d < edit.map().capacity(); d += 7) unsew(edit, 3, Dart{d});
  });
  surface.update();
  EXPECT_TRUE(surface.same_as(SolidSurface(*body)));
  for (const Triangle& t : triangles_of(surface)) EXPECT_FALSE(t.bare);
  EXPECT_FALSE(body->map->uses(FaceOfVolume)); // nor is there a slot for any face
}

// The α3-free faces, orbit by orbit, with groups by merging and neighbours by collecting <2,3>.
class BruteForce {
public:
  explicit BruteForce(const Body& body, const std::set<Dart>& born_free) : body_(body), map_(body.map->map()) {
    map_.for_each_dart([&](Dart d) {
      if (map_.is_free(3, d) && smallest_dart(map_, FaceOfVolume, d) == d) faces_.push_back(d);
    });
    for (Dart first : faces_) {
      for (Dart d : darts_of(map_, FaceOfVolume, first)) parent_[d] = smallest_dart(map_, VertexOfFace, d);
      bare_[first] = !born_free.contains(first);
    }
    for (const auto& each : std::map(parent_)) join_across(each.first);
  }

  const std::vector<Dart>& faces() const { return faces_; }
  bool bare(Dart first) const { return bare_.at(first); }

  // Twice the area at rest or now, away from the cell's middle.
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

  // By the group's name.
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
    if (bare_.at(first)) return first;
    Dart at = parent_.at(d);
    while (parent_.at(at) != at) at = parent_.at(at);
    return at;
  }

  Side side(Dart d) const {
    const Dart other = neighbour(d);
    const Dart f = smallest_dart(map_, FaceOfVolume, d), g = smallest_dart(map_, FaceOfVolume, other);
    return bare_.at(f) != bare_.at(g) || angle(d, other) > 40 ? Side::Crease : Side::Cell;
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
  // 1: the walk from d over α0(d) is outward at rest.
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
    if (other == d || bare_.at(f) || bare_.at(g) || angle(d, other) > 40) return;
    const Dart a = group(d), b = group(other);
    parent_.at(std::max(a, b)) = std::min(a, b);
  }

  const Body& body_;
  const GMap& map_;
  std::vector<Dart> faces_;
  std::map<Dart, bool> bare_;
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
  std::map<Dart, std::vector<Triangle>> faces;
  for (const Triangle& t : triangles_of(surface)) faces[t.first].push_back(t);
  ASSERT_EQ(faces.size(), brute.faces().size());
  for (Dart first : brute.faces()) {
    ASSERT_TRUE(faces.contains(first));
    Vec3 area = Vec3::Zero();
    std::map<std::pair<Slot, Slot>, Side> sides;
    std::map<Slot, Vec3> drawn;
    for (const Triangle& t : faces[first]) {
      EXPECT_EQ(t.bare, brute.bare(first));
      area += 2 * area_vector(body, t);
      for (std::size_t k = 0; k < 3; ++k) {
        drawn[t.vertex[k]] = normals[t.corner[k]];
        if (t.side[k] != Side::Inner)
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
    SolidSurface surface(*body);
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
      ASSERT_TRUE(surface.same_as(SolidSurface(*body))) << round;
      EXPECT_TRUE(open_sides(surface).empty());
      expect_equal(surface, *body, BruteForce(*body, born));
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(SolidSurface, equals_a_new_one_along_storms_of_any_edit) {
  std::vector<Named> solids = all();
  solids.push_back({"warped hexahedra", bar(BarPattern::Hexahedra, 3, 3, 3)});
  Noise warp(2); // edges of all angles, faces not flat
  for (Vec3& x : solids.back().mesh.points) x += 0.25 * warp.vector();
  for (const Named& solid : solids) {
    SCOPED_TRACE(solid.name);
    for (unsigned seed = 1; seed < 4; ++seed) {
      const auto body = solids::body(solid.mesh);
      SolidSurface surface(*body);
      Noise noise(seed);
      for (int round = 0; round < 30; ++round) {
        const auto any = [&] {
          for (;;)
            if (const Dart d{noise.below(body->map->map().capacity())}; body->map->map().alive(d)) return d;
        };
        for (int n = 0; n < 2; ++n) { // several edits to one update
          body->map->edit([&](Edit& edit) {
            for (int k = 0; k < 4; ++k) unsew(edit, 3, any());
            for (int k = 0; k < 60; ++k) sew(edit, 3, any(), any()); // faces that never met, too
            if (round % 5 == 4 && count_cells(edit.map(), Volume) > 3) remove_element(edit, any());
          });
          if (round % 3 == 1) apply(triangulate_face_both_sides, *body->map, any());
          if (round % 7 == 5) apply(insert_vertex, *body->map, any());
          if (round % 11 == 6) body->map->edit([&](Edit& edit) { unsew(edit, 2, any()); });
        }
        surface.update();
        ASSERT_TRUE(surface.same_as(SolidSurface(*body))) << "seed " << seed << ", round " << round;
        for (const Vec3& n : normals_of(surface)) ASSERT_LT(std::abs(n.norm() - 0.5), 0.5 + 1e-12);
      }
    }
  }
}

void remove_cells(Body& body, std::initializer_list<std::uint32_t> cells) {
  body.map->edit([&](Edit& edit) {
    for (std::uint32_t cell : cells) remove_element(edit, Dart{48 * cell});
  });
}

// Two holes that touch at a point of the solid: two fans around one vertex.
TEST(SolidSurface, of_a_vertex_with_two_fans_sees_both) {
  const auto body = solids::body(bar(BarPattern::Hexahedra, 2, 2, 2));
  const std::set<Dart> born = free_faces(body->map->map());
  SolidSurface surface(*body);
  remove_cells(*body, {0, 7});
  surface.update();
  EXPECT_TRUE(surface.same_as(SolidSurface(*body)));
  EXPECT_TRUE(open_sides(surface).empty());
  EXPECT_NEAR(volume_of(*body, surface), 6, 1e-12);
  std::set<Dart> in_the_middle;
  for (const Triangle& t : triangles_of(surface))
    for (Slot v : t.vertex)
      if (place(*body, v) == Vec3(1, 1, 1)) in_the_middle.insert(t.first);
  EXPECT_EQ(in_the_middle.size(), 6u);
  expect_equal(surface, *body, BruteForce(*body, born));
}

// Two cells between the same two layers that share nothing but an edge's ends: four faces there, two by two.
TEST(SolidSurface, of_an_edge_that_two_sheets_of_the_hull_touch_along_keeps_them_apart) {
  const auto body = solids::body(bar(BarPattern::Hexahedra, 2, 2, 3), false);
  SolidSurface surface(*body);
  remove_cells(*body, {5, 6});
  surface.update();
  EXPECT_TRUE(surface.same_as(SolidSurface(*body)));
  EXPECT_TRUE(open_sides(surface).empty());
  EXPECT_NEAR(volume_of(*body, surface), 10, 1e-12);
  std::size_t along = 0;
  for (const Triangle& t : triangles_of(surface))
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 x = place(*body, t.vertex[k]), y = place(*body, t.vertex[(k + 1) % 3]);
      along +=
          x.head<2>() == Vec3(1, 1, 0).head<2>() && y.head<2>() == x.head<2>() && std::abs(x.z() - y.z()) == 1;
    }
  EXPECT_EQ(along, 4u);
}

} // namespace
} // namespace rend
