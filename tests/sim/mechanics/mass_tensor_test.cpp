// Mass-tensors against the stiffness of the linear element, and folded against unfolded ones.
#include "sim/mechanics/mass_tensor.h"

#include "sim/elements.h"

#include <gtest/gtest.h>

namespace rend::mass_tensor_test {
namespace {

using namespace elements;

TEST(MassTensor, is_the_stiffness_block_by_block) {
  for (ElementKind kind : every_kind) {
    SCOPED_TRACE(shape_of(kind).name);
    const Element e(kind, every_model()[0], distorted(kind, 0.15, 8));
    const ElementTensors tensors = element_tensors(e.law->shape(), e.rest, {e.law->material(), 0.1, Place{}});
    UnitMatrix K, by_velocity;
    e.law->stiffness(e.unit.data(), e.state(), Tangent::Exact, K, by_velocity);
    for (std::size_t i = 0; i < e.corners(); ++i)
      for (std::size_t j = 0; j < e.corners(); ++j)
        EXPECT_LT((tensors.K[i][j] -
                   K.block<3, 3>(static_cast<Eigen::Index>(3 * i), static_cast<Eigen::Index>(3 * j)))
                      .norm(),
                  1e-12 * K.norm());
  }
}

std::vector<Record> forces_on(Body& body) {
  meshes::shake(body, 0.3, 4);
  std::vector<Record> forces(body.program->vertices());
  body.program->forces(meshes::positions(body), meshes::velocities(body), forces.data());
  return forces;
}

TEST(MassTensor, gives_the_forces_of_linear_elements_on_every_mesh_folded_or_not) {
  for (const double beta : {0.0, 0.05}) {
    for (std::size_t n = 0; n < irregular_maps().size(); ++n) {
      const auto map = [&] { return std::move(irregular_maps()[n].map); };
      SCOPED_TRACE(irregular_maps()[n].name);
      const auto linear = elastic_body(map(), {"linear", "polar", beta});
      const auto folded = elastic_body(map(), {"mass-tensor", "polar", beta});
      const auto unfolded = elastic_body(map(), {"mass-tensor", "polar", beta, Cumulated::No});
      const std::vector<Record> f = forces_on(*linear);
      EXPECT_LT(meshes::difference(f, forces_on(*folded)), 1e-12);
      EXPECT_LT(meshes::difference(f, forces_on(*unfolded)), 1e-12);
      EXPECT_NEAR(linear->program->elastic_energy(meshes::positions(*linear)),
                  folded->program->elastic_energy(meshes::positions(*folded)),
                  1e-11 * linear->program->elastic_energy(meshes::positions(*linear)));
    }
  }
}

std::size_t live_rows(const Body& body, std::size_t n) {
  return body.program->rows()[n].rows().live_count();
}

TEST(MassTensor, has_one_tensor_for_each_pair_and_each_vertex_when_folded) {
  // 2 × 2 × 2 hexahedra: 27 vertices, 54 edges, 36 faces, 8 volumes (fig. 5.24: 8 + 28 for a single one)
  CellMesh mesh = bar_cells({BarPattern::Hexahedra, 2, 2, 2, Vec3(2, 2, 2)});
  Noise noise(2);
  for (Vec3& x : mesh.points) x += 0.1 * noise.vector();
  const auto folded = elastic_body(solid_from(mesh), {"mass-tensor"});
  const auto unfolded = elastic_body(solid_from(mesh), {"mass-tensor", "polar", 0, Cumulated::No});
  EXPECT_EQ(live_rows(*folded, 0), 27u);
  EXPECT_EQ(live_rows(*folded, 1), 54u);
  EXPECT_EQ(live_rows(*folded, 2), 2 * 36u);
  EXPECT_EQ(live_rows(*folded, 3), 4 * 8u);
  EXPECT_EQ(live_rows(*unfolded, 0), 8 * 8u);
  EXPECT_EQ(live_rows(*unfolded, 1) + live_rows(*unfolded, 2) + live_rows(*unfolded, 3), 8 * 28u);
}

TEST(MassTensor, bounds_the_step_as_the_elements_do) {
  for (std::size_t n = 0; n < irregular_maps().size(); ++n) {
    SCOPED_TRACE(irregular_maps()[n].name);
    const auto linear = elastic_body(std::move(irregular_maps()[n].map), {"linear", "polar", 0.1});
    const auto tensors = elastic_body(std::move(irregular_maps()[n].map), {"mass-tensor", "polar", 0.1});
    const FrequencyBounds a = frequency_bounds(*linear->map, linear->interactions, *linear->mass, nullptr);
    const FrequencyBounds b = frequency_bounds(*tensors->map, tensors->interactions, *tensors->mass, nullptr);
    EXPECT_NEAR(a.omega_squared, b.omega_squared, 1e-11 * a.omega_squared);
    EXPECT_NEAR(a.damping_rate, b.damping_rate, 1e-11 * a.damping_rate);
  }
}

} // namespace
} // namespace rend::mass_tensor_test
