// Costs of rows against counts by hand.
#include "sim/rows/row_cost.h"

#include "sim/mechanics/element_law.h"
#include "sim/mechanics/spring_law.h"
#include "sim/presets.h"
#include "sim/rows/row_times.h"

#include <gtest/gtest.h>

namespace rend::row_cost_test {
namespace {

const Binder& binder_of(const Body& body, const std::string& name) {
  for (const Binder& binder : body.program->folded())
    if (binder.interaction()->name.starts_with(name)) return binder;
  throw std::runtime_error("no " + name);
}

// 4 × 4 cells: 25 vertices, 40 edges. A spring without damping reads k, rest length and two indices; for each
// vertex, 32 bytes of position are read, and 32 of force read and written.
TEST(RowCost, of_springs_counts_each_vertex_once) {
  const auto scene = presets::load(presets::cloth("quads", 4));
  const RowCost cost = cost_of(binder_of(scene.body(), "stretch"), false);
  EXPECT_DOUBLE_EQ(cost.written, 32 * 25 / 40.0);
  EXPECT_DOUBLE_EQ(cost.read, 16 + 8 + 2 * 32 * 25 / 40.0);
}

// d: 3; |d|²: 5; l; 1/|d|²; times l; l − l0; k; times 1/l; f: 3; to two vertices: 6. With damping w: 3; w·d: 5;
// times 1/l; λ; +.
TEST(RowCost, of_a_spring_is_23_operations_and_34_with_damping) {
  EXPECT_EQ(operations_of(*spring_law(), false), 3 + 5 + 6 + 3 + 6);
  EXPECT_EQ(operations_of(*spring_law(), true), 23 + 3 + 5 + 3);
}

// Edges: 9; F: 45; R of Gram and Schmidt: 53; RᵀF, a triangular matrix: 30, its trace: 2, σ: 17, its
// skew part: 2, the moment of the frame: 24, taken from σ: 6; z: 1 + 3 + 23; back: 54 and 6; turned: 45; to
// four vertices: 12.
TEST(RowCost, of_a_tetrahedron_is_what_its_formulas_take) {
  const auto law = element_law(ElementKind::Tetrahedron, ElasticModel::Corotational, Rotation::Qr,
                               ElasticMaterial::of(1000, 0.3, 3));
  EXPECT_EQ(operations_of(*law, false),
            9 + 45 + 53 + (30 + 2 + 17 + 2 + 24 + 6) + (1 + 3 + 23) + 54 + 6 + 45 + 12);
  // Polar: three cross products, 27, and seven dot products, 35, with 4 to sum them; three iterations of 23; 30
  // for the weights and 3 × 23 for the columns. tr RᵀF: 17; weights: 5; w (2μ F + ...): 27. Damped, RᵀF, ε, σ
  // and P: 118.
  const auto polar = element_law(ElementKind::Tetrahedron, ElasticModel::Corotational, Rotation::Polar,
                                 ElasticMaterial::of(1000, 0.3, 3));
  EXPECT_EQ(operations_of(*polar, false), 9 + 45 + (66 + 69 + 30 + 69) + 49 + 54 + 6 + 12);
  EXPECT_EQ(operations_of(*polar, true).value() - operations_of(*polar, false).value(), 118 - 49 + 27 + 45);
  const auto linear = element_law(ElementKind::Tetrahedron, ElasticModel::Linear, Rotation::Qr,
                                  ElasticMaterial::of(1000, 0.3, 3));
  EXPECT_EQ(operations_of(*linear, false), 9 + 45 + 22 + 54 + 6 + 12);
}

TEST(RowTimes, count_evaluations_and_seconds_where_they_are_asked_for) {
  const auto scene = presets::load(presets::cloth("quads", 8), {.profile = true});
  for (int n = 0; n < 5; ++n) scene->step();
  const RowTimes* times = scene.body().program->folded_times();
  ASSERT_NE(times, nullptr);
  EXPECT_EQ(times->evaluations(), 5 * 4); // rk4
  for (std::size_t n = 0; n < scene.body().program->folded().size(); ++n) EXPECT_GT(times->seconds(n), 0) << n;
  EXPECT_EQ(scene.body().program->elementary_times(), nullptr);
  EXPECT_EQ(presets::load(presets::cloth("quads", 8)).body().program->folded_times(), nullptr);
}

} // namespace
} // namespace rend::row_cost_test
