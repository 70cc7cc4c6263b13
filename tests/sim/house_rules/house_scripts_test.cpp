// What the built-in scripts make: counts of cells by formulas, and volumes that are kept.
#include "sim/house_rules/house_scripts.h"

#include "sim/mesh/bar.h"
#include "sim/mesh/cells.h"
#include "sim/mesh/sheet.h"
#include "sim/rules/rounds.h"
#include "tests/sim/assets.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace rend::house_scripts_test {
namespace {

// To all orbits of its hook.
RoundResult apply_all(const char* name, EmbeddedMap& body, RuleContext context = {}) {
  RuleOrScriptRunner runner(*find_house_rule_or_script(name), std::move(context));
  const RoundResult result = apply_round(body, runner);
  const auto fault = validate(body);
  EXPECT_FALSE(fault) << *fault;
  return result;
}

assets::Body bar(BarPattern pattern, int n = 2) {
  return solid_from(bar_cells({pattern, n, n, n, Vec3(1, 1.5, 2)}));
}

std::vector<Dart> one_dart_each(const GMap& map, Orbit orbit) {
  std::vector<Dart> firsts;
  map.for_each_dart([&](Dart d) {
    if (smallest_dart(map, orbit, d) == d) firsts.push_back(d);
  });
  return firsts;
}

// Of a tetrahedron, from the positions of its vertices alone.
double volume_of_tetrahedron(const EmbeddedMap& body, Dart cell) {
  std::vector<Vec3> x;
  std::set<Slot> met;
  for (Dart d : darts_of(body.map(), Volume, cell))
    if (met.insert(body.vertex(d)).second) x.push_back(body.rest_of(d));
  EXPECT_EQ(x.size(), 4u);
  return std::abs((x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0])) / 6;
}

void expect_tetrahedra_of_volume(const EmbeddedMap& body, double all) {
  double sum = 0;
  for (Dart d : one_dart_each(body.map(), Volume)) {
    ASSERT_EQ(darts_of(body.map(), Volume, d).size(), 24u);
    sum += volume_of_tetrahedron(body, d);
  }
  EXPECT_NEAR(sum, all, 1e-13 * all);
}

// Vertices V + E, edges 2 E + 3 F + T, faces 4 F + 8 T, and 8 T tetrahedra.
TEST(HouseScripts, divide_tetrahedra_makes_eight_of_each_that_fit) {
  for (int n : {1, 2, 3}) {
    const auto body = bar(BarPattern::Tetrahedra, n);
    const CellCounts was = count_cells(body->map());
    EXPECT_EQ(apply_all("divide-tetrahedra", *body).applied, 1u);
    const CellCounts is = count_cells(body->map());
    EXPECT_EQ(is.vertices, was.vertices + was.edges);
    EXPECT_EQ(is.edges, 2 * was.edges + 3 * was.faces + was.volumes);
    EXPECT_EQ(is.faces, 4 * was.faces + 8 * was.volumes);
    EXPECT_EQ(is.volumes, 8 * was.volumes);
    expect_tetrahedra_of_volume(*body, 3);
  }
}

// All have an eighth of the old volume, and no angle gets ever worse: there are few shapes.
TEST(HouseScripts, divide_tetrahedra_again_and_again_keeps_to_few_shapes) {
  const auto body = std::make_unique<EmbeddedMap>(3);
  apply(rule("create-tetrahedron"), *body, {},
        assets::corners({assets::at(0, 0), assets::at(1, 0), assets::at(0.2, 1.1), assets::at(0.3, 0.1, 0.9)}));
  const double volume = volume_of_tetrahedron(*body, Dart{0u});
  double parts = 1;
  std::size_t shapes = 0;
  for (int n = 0; n < 3; ++n) {
    apply_all("divide-tetrahedra", *body);
    parts *= 8;
    std::set<std::vector<long>> found; // lengths of edges, as shares of the whole
    for (Dart d : one_dart_each(body->map(), Volume)) {
      EXPECT_NEAR(volume_of_tetrahedron(*body, d), volume / parts, 1e-12 * volume / parts);
      std::vector<long> lengths;
      for (Dart e : darts_of(body->map(), Volume, d))
        lengths.push_back(std::lround(1e6 * std::cbrt(parts) *
                                      (body->rest_of(body->map().alpha(0, e)) - body->rest_of(e)).norm()));
      std::sort(lengths.begin(), lengths.end());
      found.insert(lengths);
    }
    if (n == 1) shapes = found.size();
    if (n == 2) {
      EXPECT_LE(found.size(), std::max<std::size_t>(shapes + 2, 5));
    }
  }
}

TEST(HouseScripts, divide_tetrahedra_refuses_other_volumes_and_changes_nothing) {
  for (BarPattern pattern : {BarPattern::Hexahedra, BarPattern::Prisms, BarPattern::Mixed}) {
    const auto body = bar(pattern);
    const auto links = assets::links(body->map());
    const RoundResult result = apply_all("divide-tetrahedra", *body);
    EXPECT_EQ(result.applied, 0u);
    EXPECT_NE(result.reason.find("step"), std::string::npos) << result.reason;
    EXPECT_EQ(assets::links(body->map()), links);
  }
}

// A tetrahedron stays; of any other volume, each triangle becomes one tetrahedron, each face of n sides n.
TEST(HouseScripts, split_into_tetrahedra_fits_volumes_of_all_kinds) {
  for (BarPattern pattern :
       {BarPattern::Hexahedra, BarPattern::Prisms, BarPattern::Mixed, BarPattern::Tetrahedra}) {
    const auto body = bar(pattern);
    std::size_t expected = 0;
    for (Dart d : one_dart_each(body->map(), Volume)) {
      const std::vector<Dart> darts = darts_of(body->map(), Volume, d);
      std::size_t parts = 0;
      for (Dart e : one_dart_each(body->map(), FaceOfVolume))
        if (std::find(darts.begin(), darts.end(), e) != darts.end())
          parts +=
              sides_of_face(body->map(), e) == 3 ? 1 : static_cast<std::size_t>(sides_of_face(body->map(), e));
      expected += darts.size() == 24 ? 1 : parts;
    }
    apply_all("split-into-tetrahedra", *body);
    EXPECT_EQ(count_cells(body->map()).volumes, expected);
    expect_tetrahedra_of_volume(*body, 3);
  }
}

TEST(HouseScripts, split_into_triangles_fits_polygons_of_all_kinds) {
  const auto body = assets::mixed_sheet();
  std::size_t sides = 0;
  for (Dart d : one_dart_each(body->map(), FaceOfVolume))
    sides += static_cast<std::size_t>(sides_of_face(body->map(), d));
  apply_all("split-into-triangles", *body);
  EXPECT_EQ(count_cells(body->map()).faces, sides);
  for (Dart d : one_dart_each(body->map(), FaceOfVolume)) EXPECT_EQ(sides_of_face(body->map(), d), 3);
}

// One volume on each face of the hull, whose own hull is that of before, larger by a quarter; nothing gapes.
TEST(HouseScripts, extrude_hull_lays_a_closed_layer_around_a_body) {
  for (BarPattern pattern :
       {BarPattern::Hexahedra, BarPattern::Prisms, BarPattern::Mixed, BarPattern::Tetrahedra}) {
    const auto body = bar(pattern);
    const auto open = [&] {
      std::map<int, int> faces; // by sides
      for (Dart d : one_dart_each(body->map(), FaceOfVolume))
        if (body->map().is_free(3, d)) ++faces[sides_of_face(body->map(), d)];
      return faces;
    };
    const auto hull = open();
    std::set<Slot> outer;
    body->map().for_each_dart([&](Dart d) {
      if (body->map().is_free(3, d)) outer.insert(body->vertex(d));
    });
    const CellCounts was = count_cells(body->map());
    RuleContext context;
    context.wheres = {scalar_value(0.25)};
    ASSERT_EQ(apply_all("extrude-hull", *body, context).applied, 1u);
    const CellCounts is = count_cells(body->map());
    std::size_t faces = 0;
    for (const auto& [sides, count] : hull) faces += static_cast<std::size_t>(count);
    EXPECT_EQ(open(), hull);
    EXPECT_EQ(is.volumes, was.volumes + faces);
    EXPECT_EQ(is.vertices, was.vertices + outer.size());
    EXPECT_EQ(is.fragments, 1u);
    double far = 0;
    body->map().for_each_dart([&](Dart d) {
      EXPECT_EQ(body->map().is_free(3, d), body->map().is_free(3, body->map().alpha(1, d)));
      far = std::max(far, body->rest_of(d).x());
    });
    Vec3 middle = Vec3::Zero(); // of the old vertices, from which the layer grew
    for (Slot v = 0; v < was.vertices; ++v) middle += body->rest()[v].vec() / static_cast<double>(was.vertices);
    EXPECT_NEAR(far, middle.x() + 1.25 * (1 - middle.x()), 1e-12);
  }
}

TEST(HouseScripts, all_are_printed_and_have_a_line_about_them) {
  EXPECT_GE(house_scripts().size(), 10u);
  for (const Script& each : house_scripts()) {
    EXPECT_FALSE(each.settings.about.empty());
    EXPECT_EQ(find_house_rule(each.name()), nullptr);
    EXPECT_EQ(&script(each.name()), &each);
  }
}

} // namespace
} // namespace rend::house_scripts_test
