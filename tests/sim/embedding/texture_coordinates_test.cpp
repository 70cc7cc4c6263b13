// Texture coordinates through ten thousand random tears, rules and cuts of sheets with a seam: against what the
// sides that are divided had, and at the end against the affine maps from rest positions that they began as.
#include "sim/embedding/texture_coordinates.h"

#include "sim/base/archive.h"
#include "sim/boundary/face_sense.h"
#include "sim/cuts/cuts.h"
#include "sim/cuts/start_element.h"
#include "sim/fracture/torn_bodies.h"
#include "sim/house_rules/house_rules.h"
#include "sim/random_meshes.h"
#include "sim/rules/apply.h"
#include "sim/topology/walk.h"
#include "tests/sim/assets.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <vector>

namespace rend::texture_coordinates_test {
namespace {

using meshes::Noise;

// The places on the two sides of the seam x = 2: other affine functions of rest positions on each.
TexturePlace place_of(const Vec3& rest, bool left) {
  const double x = rest.x(), y = rest.y(), z = rest.z();
  return left ? TexturePlace{0.11 + 0.07 * x - 0.02 * y + 0.05 * z, 0.93 - 0.09 * x - 0.06 * y - 0.03 * z}
              : TexturePlace{0.48 - 0.03 * x + 0.08 * y - 0.04 * z, 0.07 + 0.05 * x + 0.11 * y + 0.02 * z};
}

constexpr double seam = 2; // the x of an edge of cells [m]

// Of cells of about 1 m, warped; those at the seam only along it.
PolygonMesh sheet_with_seam(SheetPattern pattern, unsigned seed) {
  PolygonMesh mesh = meshes::sheet(pattern, 4, 4);
  Noise noise(seed);
  for (Vec3& x : mesh.points) {
    const Vec3 by = 0.15 * noise.vector();
    x += std::abs(x.x() - seam) < 1e-9 ? Vec3(0, by.y(), 0) : by;
  }
  for (std::size_t p = 0; p < mesh.polygons(); ++p) {
    double middle = 0;
    for (std::uint32_t c = mesh.first[p]; c < mesh.first[p + 1]; ++c)
      middle += mesh.points[mesh.corners[c]].x() - seam;
    for (std::uint32_t c = mesh.first[p]; c < mesh.first[p + 1]; ++c)
      mesh.texture.push_back(place_of(mesh.points[mesh.corners[c]], middle < 0));
  }
  return mesh;
}

bool same_bits(const TexturePlace& a, const TexturePlace& b) {
  return std::bit_cast<std::array<std::uint64_t, 2>>(a) == std::bit_cast<std::array<std::uint64_t, 2>>(b);
}

class Textured {
public:
  explicit Textured(const EmbeddedMap& map) : map_(map), places_(*find_texture_coordinates(map)) {}

  TexturePlace at(Dart d) const { return places_[map_.slot(VertexOfFace, d)]; }

  std::vector<TexturePlace> of_all_darts() const {
    std::vector<TexturePlace> all(map_.map().capacity());
    map_.map().for_each_dart([&](Dart d) { all[d.value] = at(d); });
    return all;
  }

  // Every dart that was there has what it had.
  void expect_kept(const std::vector<TexturePlace>& before, const std::vector<bool>& was_alive) const {
    for (std::uint32_t d = 0; d < before.size(); ++d)
      if (was_alive[d] && map_.map().alive(Dart{d})) {
        ASSERT_TRUE(same_bits(at(Dart{d}), before[d])) << "dart " << d;
      }
  }

  std::vector<bool> alive() const {
    std::vector<bool> all(map_.map().capacity());
    for (std::uint32_t d = 0; d < all.size(); ++d) all[d] = map_.map().alive(Dart{d});
    return all;
  }

  // By the side on which a face lies, which no division changes.
  void expect_affine() const {
    ASSERT_EQ(validate(map_), std::nullopt);
    for_each_face(map_, [&](Dart first) {
      const std::vector<Dart> darts = darts_of(map_.map(), FaceOfVolume, first);
      double middle = 0;
      for (const Dart d : darts) middle += map_.rest_of(d).x() - seam;
      for (const Dart d : darts) {
        const TexturePlace expected = place_of(map_.rest_of(d), middle < 0);
        ASSERT_NEAR(at(d).u, expected.u, 1e-12);
        ASSERT_NEAR(at(d).v, expected.v, 1e-12);
      }
    });
  }

  bool at_seam(Dart d) const {
    const GMap& map = map_.map();
    return !map.is_free(2, d) && std::abs(at(d).u - at(map.alpha(2, d)).u) > 1e-3;
  }

private:
  const EmbeddedMap& map_;
  const Column<TextureCoordinates>& places_;
};

struct Counts {
  int done = 0, divided = 0, at_seam = 0;
};

TexturePlace between(const TexturePlace& a, const TexturePlace& b, double t) {
  return {(1 - t) * a.u + t * b.u, (1 - t) * a.v + t * b.v};
}

// Applies a rule that divides an edge.
Applied divide(const char* name, EmbeddedMap& map, Dart d, const RuleArguments& arguments, Counts& counts) {
  const bool at_seam = Textured(map).at_seam(d);
  Applied done = apply(rule(name), map, d, arguments);
  if (!done.ok) return done;
  ++counts.done;
  ++counts.divided;
  counts.at_seam += at_seam;
  return done;
}

// An edge between triangles, at a share of its length; each side's new corner lies between that side's own.
void divide_edge(EmbeddedMap& map, Dart d, double share, Counts& counts) {
  const Textured textured(map);
  const std::vector<TexturePlace> before = textured.of_all_darts();
  const Applied done = divide("divide-edge-of-triangles", map, d, {{"share", scalar_value(share)}}, counts);
  if (!done.ok) return;
  const std::vector<Dart> from = done.darts("a"), to = done.darts("A");
  for (std::size_t side = 0; side < from.size(); ++side) {
    const TexturePlace expected = between(before[from[side].value], before[to[side].value], share);
    for (const char* node : {"g", "h", "G", "H"})
      ASSERT_TRUE(same_bits(textured.at(done.darts(node)[side]), expected)) << node;
  }
}

// A vertex in the middle of an edge between any faces.
void insert_vertex(EmbeddedMap& map, Dart d, Counts& counts) {
  const Textured textured(map);
  const std::vector<TexturePlace> before = textured.of_all_darts();
  const Applied done = divide("insert-vertex", map, d, {}, counts);
  if (!done.ok) return;
  const std::vector<Dart> old = done.darts("a"), created = done.darts("c");
  for (std::size_t n = 0; n < old.size(); ++n) {
    const Dart far = map.map().alpha(0, map.map().alpha(1, created[n]));
    ASSERT_TRUE(same_bits(textured.at(created[n]), between(before[old[n].value], before[far.value], 0.5)));
  }
}

std::size_t sides(const EmbeddedMap& map, Dart d) {
  return darts_of(map.map(), FaceOfVolume, d).size() / 2;
}

// Two new vertices in one edit, the second on a part of an edge that the first made.
void divide_twice(EmbeddedMap& map, Dart d, Counts& counts) {
  const RuleArguments third{{"share", scalar_value(0.25)}};
  map.edit([&](Edit& edit) {
    const Applied first = apply(rule("divide-edge-of-triangles"), edit, d, third);
    if (!first.ok) return;
    ++counts.done;
    const Applied second = apply(rule("divide-edge-of-triangles"), edit, first.dart("h"), third);
    counts.done += second.ok;
  });
}

void change(EmbeddedMap& map, Noise& noise, Counts& counts) {
  const std::vector<Dart> darts = assets::all_darts(map.map());
  const Dart d = darts[noise.below(darts.size())];
  const GMap& links = map.map();
  const bool triangles = sides(map, d) == 3 && sides(map, links.alpha(2, d)) == 3;
  const auto apply_one = [&](const char* name) { counts.done += apply(rule(name), map, d, {}).ok; };
  switch (noise.below(8)) {
  case 0:
  case 1:
    if (triangles) return divide_edge(map, d, 0.5 + 0.45 * noise(), counts);
    return insert_vertex(map, d, counts);
  case 2:
    return insert_vertex(map, d, counts);
  case 3:
    if (triangles) return divide_twice(map, d, counts);
    return apply_one("star-face");
  case 4:
    return apply_one("star-face");
  case 5: { // between two corners of a face that are no neighbours
    const Dart across = links.alpha(0, links.alpha(1, links.alpha(0, d)));
    if (sides(map, d) > 3) counts.done += apply(rule("insert-edge"), map, Hooks{d, across}, {}).ok;
    return;
  }
  case 6:
    return apply_one("unsew-edge");
  default:
    if (noise.below(8) == 0) return apply_one("halve-triangles");
    return apply_one("unsew-edge");
  }
}

TEST(TextureCoordinates, of_sheets_that_rules_tear_and_divide_stay_what_they_are_on_each_side_of_a_seam) {
  Counts counts;
  for (unsigned seed = 0; seed < 60 && !HasFatalFailure(); ++seed) {
    SCOPED_TRACE(seed);
    using enum SheetPattern;
    const auto pattern = std::array{Triangles, Quads, Mixed, Crossed}[seed % 4];
    const auto map = sheet_from(sheet_with_seam(pattern, seed));
    const Textured textured(*map);
    textured.expect_affine();
    Noise noise(seed + 100);
    for (int n = 0; n < 250 && !HasFatalFailure(); ++n) {
      const std::vector<TexturePlace> before = textured.of_all_darts();
      const std::vector<bool> alive = textured.alive();
      change(*map, noise, counts);
      textured.expect_kept(before, alive);
    }
    textured.expect_affine();
  }
  EXPECT_GT(counts.done, 12000);
  EXPECT_GT(counts.divided, 5000);
  EXPECT_GT(counts.at_seam, 100);
}

// With springs no vertex moves.
TEST(TextureCoordinates, of_sheets_that_are_cut_stay_what_they_are_on_each_side_of_a_seam) {
  int cuts = 0;
  std::size_t born = 0;
  for (unsigned seed = 0; seed < 120 && !HasFatalFailure(); ++seed) {
    SCOPED_TRACE(seed);
    auto map = sheet_from(sheet_with_seam(SheetPattern::Triangles, seed));
    map->let_grow();
    map->add(FaceSense{});
    add_start_elements(*map);
    const auto body = torn::body(std::move(map), {}, "symplectic", true, true);
    const auto by = cuts::cuts_of(*body);
    const Textured textured(*body->map);
    const std::size_t start = body->vertices();
    Noise noise(seed);
    for (int n = 0; n < 150 && !HasFatalFailure(); ++n) {
      const std::vector<TexturePlace> before = textured.of_all_darts();
      const std::vector<bool> alive = textured.alive();
      const Dart d{noise.below(body->map->map().capacity())};
      cuts += cuts::cut_at(*body, *by, d, Vec3(noise(), noise(), 0.2 * noise()).normalized());
      textured.expect_kept(before, alive);
    }
    born += body->vertices() - start;
    textured.expect_affine();
  }
  EXPECT_GT(cuts, 2000);
  EXPECT_GT(born, 2000U);
}

TEST(TextureCoordinates, are_stored_and_come_back_to_the_bit) {
  const auto grown = [](unsigned seed, int changes) {
    auto map = sheet_from(sheet_with_seam(SheetPattern::Triangles, 5));
    map->let_grow();
    Noise noise(seed);
    Counts counts;
    for (int n = 0; n < changes; ++n) change(*map, noise, counts);
    return map;
  };
  const auto map = grown(1, 100), other = grown(2, 30);
  ASSERT_NE(Textured(*map).of_all_darts().size(), Textured(*other).of_all_darts().size());
  Archive archive;
  map->store(archive);
  Archive reader{std::span<const std::uint8_t>(archive.bytes())};
  other->store(reader);
  reader.end();
  const auto expected = Textured(*map).of_all_darts(), found = Textured(*other).of_all_darts();
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t d = 0; d < found.size(); ++d) EXPECT_TRUE(same_bits(found[d], expected[d]));
  Textured(*other).expect_affine();
}

TEST(TextureCoordinates, are_there_only_where_the_mesh_has_them) {
  PolygonMesh mesh = sheet_with_seam(SheetPattern::Quads, 3);
  EXPECT_TRUE(find_texture_coordinates(*sheet_from(mesh)));
  mesh.texture.clear();
  const auto map = sheet_from(mesh);
  EXPECT_FALSE(find_texture_coordinates(*map));
  EXPECT_FALSE(map->uses(VertexOfFace));
}

} // namespace
} // namespace rend::texture_coordinates_test
