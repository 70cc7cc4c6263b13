// Slits: where they open a sheet, what they keep, and what is refused.
#include "sim/build/slit.h"
#include "sim/cuts/start_element.h"
#include "sim/mechanics/mass.h"
#include "sim/presets.h"
#include "sim/random_meshes.h"
#include "sim/topology/count.h"
#include "sim/topology/walk.h"

#include <gtest/gtest.h>

namespace rend::slit_test {
namespace {

SlitSettings slit(std::vector<double> along, std::optional<std::vector<double>> dash = {}) {
  return {.along = std::move(along), .dash = std::move(dash)};
}

std::unique_ptr<EmbeddedMap> flat(SheetPattern pattern, unsigned seed) {
  PolygonMesh mesh = meshes::warped(meshes::sheet(pattern, 12, 9), 0.15, seed);
  for (Vec3& x : mesh.points) x.z() = 0;
  return sheet_from(mesh);
}

double area(const EmbeddedMap& map) {
  double sum = 0;
  for_each_face(map, [&](Dart d) { sum += rest_area(map, d); });
  return sum;
}

double border_length(const EmbeddedMap& map) {
  double sum = 0;
  map.map().for_each_dart([&](Dart d) {
    if (map.map().is_free(2, d)) sum += (map.rest_of(d) - map.rest_of(map.map().alpha(0, d))).norm() / 2;
  });
  return sum;
}

class SlitOf : public testing::TestWithParam<SheetPattern> {};

TEST_P(SlitOf, a_sheet_opens_its_line_and_keeps_the_area) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    const auto map = flat(GetParam(), seed);
    meshes::Noise noise(seed);
    const auto inside = [&] { return Vec3(6 + 4 * noise(), 4.5 + 3 * noise(), 0); };
    const Vec3 a = inside(), b = inside(), c = inside();
    if ((b - a).norm() < 2 || (c - b).norm() < 2 || (c - b).dot(b - a) < 0) continue; // back along the way
    const double before = area(*map), border = border_length(*map), line = (b - a).norm() + (c - b).norm();
    cut_slits(*map, std::vector{slit({a.x(), a.y(), 0, b.x(), b.y(), 0, c.x(), c.y(), 0})});
    EXPECT_EQ(validate(*map), std::nullopt);
    EXPECT_NEAR(area(*map), before, 1e-12 * before);
    EXPECT_NEAR(border_length(*map) - border, 2 * line, 0.02 * line) << seed;
    EXPECT_EQ(count_cells(map->map()).fragments, 1u);
  }
}

TEST_P(SlitOf, a_sheet_from_side_to_side_parts_it) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    const auto map = flat(GetParam(), seed);
    meshes::Noise noise(seed);
    const double y = 4.5 + 3 * noise(), z = 4.5 + 3 * noise();
    cut_slits(*map, std::vector{slit({-1, y, 0, 13, z, 0})});
    EXPECT_EQ(validate(*map), std::nullopt);
    EXPECT_EQ(count_cells(map->map()).fragments, 2u) << seed;
  }
}

TEST_P(SlitOf, a_sheet_that_cross_part_it_in_four) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    const auto map = flat(GetParam(), seed);
    cut_slits(*map, std::vector{slit({-1, 4, 0, 13, 5.2, 0}), slit({5, -1, 0, 7.1, 10, 0})});
    EXPECT_EQ(validate(*map), std::nullopt);
    EXPECT_EQ(count_cells(map->map()).fragments, 4u) << seed;
  }
}

TEST_P(SlitOf, a_sheet_with_dashes_opens_those_alone) {
  double error = 0; // [m]
  meshes::Noise noise(3);
  const unsigned sheets = 30;
  for (unsigned seed = 0; seed < sheets; ++seed) {
    const auto map = flat(GetParam(), seed);
    const double border = border_length(*map);
    const double x = 1 + noise(), y = 3 + noise(), turned = 0.3 * noise();
    cut_slits(*map, std::vector{slit({x, y, 0, x + 10.5 * std::cos(turned), y + 10.5 * std::sin(turned), 0},
                                     {{2.5, 2}})});
    const double off = (border_length(*map) - border) / 2 - (2 * 2.5 + 1.5);
    EXPECT_LT(std::abs(off), 5 * 0.5); // each of five ends at the nearest vertex of a mesh of 1 m
    error += off / sheets;
    EXPECT_EQ(validate(*map), std::nullopt);
    EXPECT_EQ(count_cells(map->map()).fragments, 1u);
  }
  EXPECT_NEAR(error, 0, 0.4); // three standard errors
}

TEST_P(SlitOf, a_body_that_cuts_tear_keeps_the_sizes_of_the_start) {
  const std::string pattern = GetParam() == SheetPattern::Triangles ? "triangles" : "crossed";
  const auto text = [&](const std::string& change) {
    return "<scene><body><sheet pattern=\"" + pattern +
           R"(" cells="8 5" size="1.6 1"/><slit along="0.13 0.2 0  1.51 0.55 0"/>
        <slit along="0.4 -0.1 0  1.2 1.1 0"/><place scale="3" rotate="0 0 20"/>
        <mass density="1000" thickness="1e-3"/>
        <elasticity model="corotational" young="1e5" poisson="0.3" thickness="1e-3"/>
        <tear criterion="vertex-stress" threshold="1e9" change=")" +
           change + R"("/></body><world gravity="0 0 0"/><time duration="1"/></scene>)";
  };
  const auto cut = presets::load(text("cut")), parted = presets::load(text("separate"));
  EXPECT_EQ(find_start_elements(*parted.body().map), nullptr);
  const EmbeddedMap& map = *cut.body().map;
  const Column<StartElement>* start = find_start_elements(map);
  ASSERT_NE(start, nullptr);
  const double cell = 0.6 * 0.6, whole = pattern == "triangles" ? cell : cell / 2; // twice the area [m²]
  std::size_t parts = 0;
  for_each_face(map, [&](Dart d) {
    EXPECT_NEAR((*start)[map.slot(FaceOfVolume, d)].size, whole, 1e-12 * whole);
    EXPECT_GE(2 * rest_area(map, d), 0.049 * whole);
    ++parts;
  });
  EXPECT_GT(parts, pattern == "triangles" ? 80u : 160u);
}

INSTANTIATE_TEST_SUITE_P(OfEach, SlitOf, testing::Values(SheetPattern::Triangles, SheetPattern::Crossed),
                         [](const auto& of) {
                           return std::string(of.param == SheetPattern::Triangles ? "triangles" : "crossed");
                         });

std::string refusal(const SlitSettings& settings, SheetPattern pattern = SheetPattern::Triangles) {
  const auto map = flat(pattern, 1);
  try {
    cut_slits(*map, std::vector{settings});
  } catch (const UserError& error) {
    EXPECT_EQ(error.code, Exit::BadInput);
    return error.what();
  }
  return "";
}

TEST(Slit, refuses_what_it_cannot_cut) {
  EXPECT_EQ(refusal(slit({20, 1, 0, 21, 1, 0})), "the slit lies outside of its body");
  EXPECT_EQ(refusal(slit({3, 1, 5, 4, 1, 5})), "the slit lies outside of its body");
  EXPECT_EQ(refusal(slit({3, 1, 0, 3, 1, 0})), "two points of the slit are the same");
  EXPECT_EQ(refusal(slit({3, 1, 0})), "3 numbers are no points of a slit");
  EXPECT_EQ(refusal(slit({3, 1, 0, 5, 1, 0, 6})), "7 numbers are no points of a slit");
  EXPECT_EQ(refusal(slit({3, 1, 0, 5, 1, 0}, {{0.1}})), "a length to cut has none to leave after it");
  EXPECT_EQ(refusal(slit({3, 1, 0, 5, 1, 0}, {{1e-9, 1e-9}})), "the slit may have more than 10000 parts");
  EXPECT_EQ(refusal(slit({3, 1, 0, 9, 1, 0}, {{1, 0.1}})), "the elements are too large for a length of 0.1 m");
  EXPECT_EQ(refusal(slit({3, 1, 0, 9, 1, 0}, {{0.1, 1}})), "the elements are too large for a length of 0.1 m");
  EXPECT_EQ(refusal(slit({3, 1, 0, 15, 1, 0, 5, 2, 0})), "the slit leaves its body between two of its points");
  EXPECT_EQ(refusal(slit({3, 1, 0, 5, 1, 0}), SheetPattern::Quads),
            "slits go through sheets of triangles, and this body is none");
}

} // namespace
} // namespace rend::slit_test
