// Recognizing elements in a map, from every dart.
#include "sim/mechanics/element.h"

#include "sim/elements.h"
#include "sim/house_rules/house_rules.h"
#include "sim/rules/apply.h"
#include "sim/topology/walk.h"

#include <gtest/gtest.h>

namespace rend::element_test {
namespace {

using namespace elements;

std::unique_ptr<EmbeddedMap> single(ElementKind kind, const std::vector<Vec3>& corners) {
  CellMesh mesh;
  mesh.points = corners;
  std::vector<std::uint32_t> indices(corners.size());
  for (std::uint32_t n = 0; n < indices.size(); ++n) indices[n] = n;
  const CellKind cell = kind == ElementKind::Tetrahedron  ? CellKind::Tetrahedron
                        : kind == ElementKind::Hexahedron ? CellKind::Hexahedron
                        : kind == ElementKind::Prism      ? CellKind::Prism
                                                          : CellKind::Pyramid;
  mesh.add(cell, indices);
  return solid_from(mesh);
}

double volume_by_points(const ElementShape& shape, const std::vector<double>& values) {
  double volume = 0;
  const std::size_t stride = static_cast<std::size_t>(shape.dimension * shape.dimension + 1);
  for (std::size_t g = 1; g <= shape.points.size(); ++g) volume += values[g * stride - 1];
  return volume;
}

// Wherever the first dart of an element is after an edit, exactly one of its darts is a unit, and identifies
// the same element.
TEST(Element, is_recognised_from_each_of_its_darts) {
  for (ElementKind kind :
       {ElementKind::Tetrahedron, ElementKind::Hexahedron, ElementKind::Prism, ElementKind::Pyramid}) {
    const ElementShape& shape = shape_of(kind);
    SCOPED_TRACE(shape.name);
    std::vector<Vec3> corners = regular(kind);
    for (Vec3& x : corners) x = Vec3(2, 0.5, 1.5).cwiseProduct(x);
    const auto map = single(kind, corners);
    EXPECT_EQ(map->map().dart_count(), static_cast<std::size_t>(shape.darts));
    map->map().for_each_dart([&](Dart d) {
      const auto at = element_at(map->map(), d);
      ASSERT_TRUE(at);
      EXPECT_EQ(at->kind, kind);
      EXPECT_EQ(at->first, Dart{0u});
      const std::vector<Vec3> rest = rest_positions(*map, d, shape.units[at->unit]);
      std::vector<double> values(static_cast<std::size_t>(shape.values()));
      ASSERT_TRUE(write_element(shape, rest.data(), Eigen::Matrix3d::Identity(), 1, values.data()));
      EXPECT_NEAR(volume_by_points(shape, values), rest_volume(*map, d), 1e-14);
    });
    // generators number darts so that the first dart fits the plain pattern
    EXPECT_EQ(element_at(map->map(), Dart{0u})->unit, 0u);
  }
}

TEST(Element, points_integrate_the_volume_of_sheared_ones) {
  for (ElementKind kind :
       {ElementKind::Tetrahedron, ElementKind::Prism, ElementKind::Pyramid, ElementKind::Hexahedron}) {
    const ElementShape& shape = shape_of(kind);
    std::vector<double> values(static_cast<std::size_t>(shape.values()));
    std::vector<Vec3> sheared = regular(kind);
    for (Vec3& x : sheared) x = Vec3(x.x() + 0.3 * x.y(), 1.2 * x.y() - 0.2 * x.z(), 0.8 * x.z() + 0.1 * x.x());
    ASSERT_TRUE(write_element(shape, sheared.data(), Eigen::Matrix3d::Identity(), 1, values.data()));
    const auto map = single(kind, sheared);
    EXPECT_NEAR(volume_by_points(shape, values), rest_volume(*map, Dart{0u}), 1e-14) << shape.name;
  }
}

TEST(Element, of_a_sheet_is_a_triangle_or_a_quad) {
  const auto map = sheet_from(meshes::bricks(6, 3));
  std::array<int, 8> sides{};
  for_each_face(*map, [&](Dart d) {
    const auto at = element_at(map->map(), d);
    const int count = sides_of_face(map->map(), d);
    ++sides[static_cast<std::size_t>(count)];
    EXPECT_EQ(at.has_value(), count == 3 || count == 4);
    if (!at) return;
    EXPECT_EQ(at->kind, count == 3 ? ElementKind::Triangle : ElementKind::Quad);
  });
  EXPECT_GT(sides[3] * sides[4] * sides[5] * sides[6], 0);
}

TEST(Element, a_volume_that_is_no_element_is_none) {
  const auto sheet = sheet_from(meshes::sheet(SheetPattern::Quads, 2, 2));
  EXPECT_TRUE(element_at(sheet->map(), Dart{0u}));
  const auto map = single(ElementKind::Hexahedron, regular(ElementKind::Hexahedron));
  map->edit([&](Edit& edit) { unsew(edit, 2, Dart{0u}); }); // not closed
  EXPECT_FALSE(element_at(map->map(), Dart{5u}));
}

} // namespace
} // namespace rend::element_test
