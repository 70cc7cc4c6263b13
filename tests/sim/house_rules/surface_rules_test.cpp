// Catmull-Clark, edge flip and edge collapse against the same on lists of corners, which know no darts; and the
// rules of the thesis that only move vertices.
#include "sim/house_rules/house_rules.h"
#include "sim/mesh/polygons.h"
#include "tests/sim/assets.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace rend::surface_rules_test {
namespace {

struct Surface {
  std::vector<Vec3> points;
  std::vector<std::vector<std::size_t>> faces; // corners in order

  std::unique_ptr<EmbeddedMap> map() const {
    PolygonMesh mesh;
    mesh.points = points;
    mesh.first.push_back(0);
    for (const auto& face : faces) {
      for (std::size_t v : face) mesh.corners.push_back(static_cast<std::uint32_t>(v));
      mesh.first.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
    }
    return sheet_from(mesh);
  }
};

// The corners of faces by their places, in steps of 1e-9: each begins at its least corner, on the less of its
// sides.
using Places = std::vector<std::array<long long, 3>>;
Places normal(Places corners) {
  Places best;
  for (int side = 0; side < 2; ++side) {
    for (std::size_t n = 0; n < corners.size(); ++n) {
      std::rotate(corners.begin(), corners.begin() + 1, corners.end());
      if (best.empty() || corners < best) best = corners;
    }
    std::reverse(corners.begin(), corners.end());
  }
  return best;
}
std::array<long long, 3> place(const Vec3& x) {
  return {std::llround(x.x() * 1e9), std::llround(x.y() * 1e9), std::llround(x.z() * 1e9)};
}

std::multiset<Places> faces_of(const Surface& surface) {
  std::multiset<Places> all;
  for (const auto& face : surface.faces) {
    Places corners;
    for (std::size_t v : face) corners.push_back(place(surface.points[v]));
    all.insert(normal(corners));
  }
  return all;
}

std::multiset<Places> faces_of(const EmbeddedMap& body) {
  std::multiset<Places> all;
  body.map().for_each_dart([&](Dart d) {
    if (smallest_dart(body.map(), Face, d) != d) return;
    Places corners;
    Dart at = d;
    do {
      corners.push_back(place(body.position_of(at)));
      at = body.map().alpha(1, body.map().alpha(0, at));
    } while (at != d);
    all.insert(normal(corners));
  });
  return all;
}

using EdgeKey = std::pair<std::size_t, std::size_t>;
EdgeKey edge(std::size_t a, std::size_t b) {
  return {std::min(a, b), std::max(a, b)};
}

// By the definition, from lists alone.
Surface catmull_clark_of(const Surface& from) {
  Surface to;
  std::map<EdgeKey, std::vector<Vec3>> faces_at_edge;
  std::vector<Vec3> face_points;
  std::vector<std::vector<Vec3>> faces_at(from.points.size());
  for (const auto& face : from.faces) {
    Vec3 middle = Vec3::Zero();
    for (std::size_t v : face) middle += from.points[v] / static_cast<double>(face.size());
    face_points.push_back(middle);
    for (std::size_t n = 0; n < face.size(); ++n) {
      faces_at_edge[edge(face[n], face[(n + 1) % face.size()])].push_back(middle);
      faces_at[face[n]].push_back(middle);
    }
  }
  std::vector<std::vector<Vec3>> middles(from.points.size()), neighbours_on_border(from.points.size());
  std::map<EdgeKey, std::size_t> edge_point;
  for (std::size_t v = 0; v < from.points.size(); ++v) to.points.push_back(Vec3::Zero());
  for (const auto& [key, faces] : faces_at_edge) {
    const Vec3 a = from.points[key.first], b = from.points[key.second];
    edge_point[key] = to.points.size();
    to.points.push_back(faces.size() == 2 ? Vec3((a + b + faces[0] + faces[1]) / 4) : Vec3((a + b) / 2));
    for (std::size_t v : {key.first, key.second}) middles[v].push_back((a + b) / 2);
    if (faces.size() == 2) continue;
    neighbours_on_border[key.first].push_back(b);
    neighbours_on_border[key.second].push_back(a);
  }
  for (std::size_t v = 0; v < from.points.size(); ++v) {
    const Vec3 s = from.points[v];
    const auto n = static_cast<double>(middles[v].size());
    if (const auto& border = neighbours_on_border[v]; !border.empty()) {
      to.points[v] = (border[0] + 6 * s + border[1]) / 8;
      continue;
    }
    Vec3 q = Vec3::Zero(), r = Vec3::Zero();
    for (const Vec3& each : faces_at[v]) q += each / n;
    for (const Vec3& each : middles[v]) r += each / n;
    to.points[v] = (q + 2 * r + (n - 3) * s) / n;
  }
  for (std::size_t f = 0; f < from.faces.size(); ++f) {
    const auto& face = from.faces[f];
    to.points.push_back(face_points[f]);
    for (std::size_t n = 0; n < face.size(); ++n) {
      const std::size_t before = face[(n + face.size() - 1) % face.size()], next = face[(n + 1) % face.size()];
      to.faces.push_back(
          {face[n], edge_point[edge(face[n], next)], to.points.size() - 1, edge_point[edge(before, face[n])]});
    }
  }
  return to;
}

Surface cube() {
  Surface out;
  for (int z : {-1, 1})
    for (int y : {-1, 1})
      for (int x : {-1, 1}) out.points.push_back(Vec3(x, y, z));
  out.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return out;
}

// Columns x rows quads in the plane, each corner moved a little; `halved`: each in two triangles.
Surface uneven_sheet(std::size_t columns, std::size_t rows, bool halved) {
  Surface out;
  for (std::size_t y = 0; y <= rows; ++y)
    for (std::size_t x = 0; x <= columns; ++x) {
      const auto n = static_cast<double>(out.points.size());
      out.points.push_back({static_cast<double>(x) + 0.1 * std::sin(7 * n),
                            static_cast<double>(y) + 0.1 * std::sin(11 * n),
                            halved ? 0 : 0.2 * std::sin(5 * n)});
    }
  for (std::size_t y = 0; y < rows; ++y)
    for (std::size_t x = 0; x < columns; ++x) {
      const std::size_t a = y * (columns + 1) + x, b = a + 1, c = b + columns + 1, d = c - 1;
      if (halved)
        out.faces.insert(out.faces.end(), {{a, b, c}, {a, c, d}});
      else
        out.faces.push_back({a, b, c, d});
    }
  return out;
}

void expect_catmull_clark(const Surface& surface, int times) {
  const auto body = surface.map();
  Surface expected = surface;
  for (int n = 0; n < times; ++n) {
    const Applied done = apply(rule("catmull-clark"), *body, Dart{0u});
    ASSERT_TRUE(done.ok) << done.reason;
    expected = catmull_clark_of(expected);
    EXPECT_EQ(faces_of(*body), faces_of(expected)) << n;
  }
  const auto fault = validate(*body);
  EXPECT_FALSE(fault) << fault.value_or("");
}

TEST(CatmullClark, of_surfaces_of_all_kinds_is_that_of_the_formulas) {
  expect_catmull_clark(cube(), 3);
  expect_catmull_clark(uneven_sheet(3, 4, false), 2); // with a border
  expect_catmull_clark(uneven_sheet(3, 2, true), 2);  // of triangles
  Surface mixed = uneven_sheet(2, 2, false);          // a quad, two triangles, and a pentagon beside them
  mixed.faces = {{0, 1, 4, 3}, {1, 2, 5}, {1, 5, 4}, {3, 4, 5, 8, 7}};
  mixed.points.erase(mixed.points.begin() + 6);
  for (auto& face : mixed.faces)
    for (std::size_t& v : face) v -= v > 6 ? 1 : 0;
  expect_catmull_clark(mixed, 2);
}

// 5/9 and 3/4 are those of Catmull and Clark's own example.
TEST(CatmullClark, of_a_cube_has_the_known_points) {
  const auto body = cube().map();
  ASSERT_TRUE(apply(rule("catmull-clark"), *body, Dart{0u}).ok);
  const CellCounts counts = count_cells(body->map());
  EXPECT_EQ(counts.vertices, 26u);
  EXPECT_EQ(counts.edges, 48u);
  EXPECT_EQ(counts.faces, 24u);
  std::map<std::array<long long, 3>, int> sizes; // |x|, |y|, |z| in increasing order
  for (Dart d : darts_of(body->map(), Component, Dart{0u})) {
    if (smallest_dart(body->map(), Vertex, d) != d) continue;
    std::array<long long, 3> at = place(body->position_of(d).cwiseAbs());
    std::sort(at.begin(), at.end());
    ++sizes[at];
  }
  EXPECT_EQ(sizes,
            (std::map<std::array<long long, 3>, int>{
                {place({0, 0, 1}), 6}, {place({0, 0.75, 0.75}), 12}, {place(Vec3::Constant(5.0 / 9)), 8}}));
}

// At every dart of a triangulated sheet, in turn.
template <class F> void at_every_edge(const Surface& surface, const char* name, F&& expected) {
  const auto original = surface.map();
  int applied = 0, refused = 0;
  original->map().for_each_dart([&](Dart d) {
    const auto body = surface.map();
    const auto index = [&](Dart e) {
      for (std::size_t v = 0; v < surface.points.size(); ++v)
        if (surface.points[v] == original->position_of(e)) return v;
      return surface.points.size();
    };
    const std::size_t a = index(d), b = index(original->map().alpha(0, d));
    const std::optional<Surface> wanted = expected(a, b);
    const Applied done = apply(rule(name), *body, d);
    EXPECT_EQ(done.ok, wanted.has_value()) << done.reason << " at " << a << ", " << b;
    (done.ok ? applied : refused) += 1;
    if (!done.ok || !wanted) return;
    EXPECT_EQ(faces_of(*body), faces_of(*wanted)) << a << ", " << b;
    const auto fault = validate(*body);
    EXPECT_FALSE(fault) << fault.value_or("");
  });
  EXPECT_GT(applied, 10);
  EXPECT_GT(refused, 5);
}

// The corners of triangles opposite to an edge.
std::vector<std::size_t> opposite(const Surface& surface, std::size_t a, std::size_t b) {
  std::vector<std::size_t> out;
  for (const auto& face : surface.faces) {
    std::set<std::size_t> rest(face.begin(), face.end());
    if (rest.erase(a) + rest.erase(b) == 2) out.push_back(*rest.begin());
  }
  return out;
}

TEST(FlipEdge, exchanges_the_diagonals_of_convex_quads) {
  const Surface surface = uneven_sheet(4, 3, true);
  at_every_edge(surface, "flip-edge", [&](std::size_t a, std::size_t b) -> std::optional<Surface> {
    const std::vector<std::size_t> far = opposite(surface, a, b);
    if (far.size() != 2) return {};
    // Both diagonals cross: each parts the ends of the other.
    const auto side = [&](std::size_t p, std::size_t q, std::size_t r) {
      return (surface.points[q] - surface.points[p]).cross(surface.points[r] - surface.points[p]).z();
    };
    if (side(far[0], far[1], a) * side(far[0], far[1], b) >= 0) return {};
    Surface flipped = surface;
    std::erase_if(flipped.faces, [&](const auto& face) {
      const std::set<std::size_t> corners(face.begin(), face.end());
      return corners.contains(a) && corners.contains(b);
    });
    flipped.faces.push_back({a, far[0], far[1]});
    flipped.faces.push_back({b, far[0], far[1]});
    return flipped;
  });
}

TEST(FlipEdge, twice_is_nothing) {
  const Surface surface = uneven_sheet(2, 2, true);
  const auto body = surface.map();
  for (Dart d : assets::all_darts(body->map())) {
    const Applied once = apply(rule("flip-edge"), *body, d);
    if (!once.ok) continue;
    EXPECT_NE(faces_of(*body), faces_of(surface));
    ASSERT_TRUE(apply(rule("flip-edge"), *body, once.dart("d")).ok);
    EXPECT_EQ(faces_of(*body), faces_of(surface));
    return;
  }
  FAIL() << "no edge could be flipped";
}

TEST(CollapseEdge, puts_both_ends_into_the_middle_and_drops_what_has_no_area) {
  const Surface surface = uneven_sheet(5, 4, true);
  std::map<std::size_t, int> neighbours, borders; // of a vertex
  std::map<EdgeKey, int> faces;
  for (const auto& face : surface.faces)
    for (std::size_t n = 0; n < 3; ++n) ++faces[edge(face[n], face[(n + 1) % 3])];
  for (const auto& [key, count] : faces)
    for (std::size_t v : {key.first, key.second}) {
      ++neighbours[v];
      borders[v] += count == 1;
    }
  at_every_edge(surface, "collapse-edge", [&](std::size_t a, std::size_t b) -> std::optional<Surface> {
    const bool border = faces[edge(a, b)] == 1;
    for (std::size_t far : opposite(surface, a, b)) {
      if (neighbours[far] <= 3) return {};
      for (std::size_t end : {a, b}) // nothing lies beyond
        if (faces[edge(far, end)] == 1) return {};
    }
    if (!border && borders[a] > 0 && borders[b] > 0) return {};
    Surface collapsed = surface;
    collapsed.points[a] = collapsed.points[b] = (surface.points[a] + surface.points[b]) / 2;
    std::erase_if(collapsed.faces, [&](const auto& face) {
      const std::set<std::size_t> corners(face.begin(), face.end());
      return corners.contains(a) && corners.contains(b);
    });
    return collapsed;
  });
}

TEST(ThesisRules, move_a_corner_and_shape_a_quad_and_nothing_else) {
  const auto body = uneven_sheet(2, 1, false).map(), before = uneven_sheet(2, 1, false).map();
  ASSERT_TRUE(apply(rule("move-quad-corner"), *body, Dart{0u}, {{"v", vector_value(0.1, 0.2, 0.3)}}).ok);
  body->map().for_each_dart([&](Dart d) {
    const bool moved = body->vertex(d) == body->vertex(Dart{0u});
    EXPECT_EQ(body->position_of(d), before->position_of(d) + (moved ? Vec3(0.1, 0.2, 0.3) : Vec3(0, 0, 0)));
  });
  const auto quad = uneven_sheet(1, 1, false).map();
  ASSERT_TRUE(apply(rule("shape-quad"), *quad, Dart{0u}).ok);
  Surface shaped;
  shaped.points = {{0, 0, 0}, {1.5, 0.25, 0}, {1.25, 1, 0}, {0.25, 1, 0}};
  shaped.faces = {{0, 1, 2, 3}};
  EXPECT_EQ(faces_of(*quad), faces_of(shaped));
  const auto triangles = uneven_sheet(1, 1, true).map();
  EXPECT_FALSE(apply(rule("move-quad-corner"), *triangles, Dart{0u}).ok);
  EXPECT_FALSE(apply(rule("shape-quad"), *triangles, Dart{0u}).ok);
}

// Against the rotation matrix of Eigen; what turns keeps its speed, turned as well.
TEST(ThesisRules, turn_is_a_rotation) {
  const auto body = uneven_sheet(3, 2, false).map(), before = uneven_sheet(3, 2, false).map();
  const Vec3 axis(1, -2, 0.5), centre(0.3, 0.1, -1);
  const auto made_of = [](const Vec3& v) { return vector_value(v.x(), v.y(), v.z()); };
  for (Record& v : body->velocity().values()) v = Record(1, 2, 3);
  ASSERT_TRUE(apply(rule("turn"), *body, Dart{0u},
                    {{"angle", scalar_value(0.7)}, {"axis", made_of(axis)}, {"centre", made_of(centre)}})
                  .ok);
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(0.7, axis.normalized()).toRotationMatrix();
  body->map().for_each_dart([&](Dart d) {
    const Vec3 expected = centre + rotation * (before->position_of(d) - centre);
    EXPECT_LT((body->position_of(d) - expected).norm(), 1e-14);
    EXPECT_LT((body->velocity()[body->vertex(d)].vec() - rotation * Vec3(1, 2, 3)).norm(), 1e-14);
  });
}

} // namespace
} // namespace rend::surface_rules_test
