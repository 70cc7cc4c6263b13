// The kernels of elements and mass-tensors against their laws, and bodies with them against walking the map.
#include "sim/elements.h"
#include "sim/rows/kernels.h"
#include "sim/rows/walk_forces.h"

#include <gtest/gtest.h>

namespace rend::element_kernel_test {
namespace {

using namespace elements;
using meshes::difference;
using meshes::positions;
using meshes::velocities;

const std::vector<Elastic>& recipes() {
  static const std::vector<Elastic> all = [] {
    std::vector<Elastic> list;
    for (const double beta : {0.0, 0.02})
      for (const auto& [model, rotation] : {std::pair{"linear", "polar"},
                                            {"corotational", "qr"},
                                            {"corotational", "polar"},
                                            {"mass-tensor", "polar"}})
        for (const Formulation formulation : {Formulation::Plain, Formulation::Enhanced})
          if (model != std::string("mass-tensor") || formulation == Formulation::Plain)
            list.push_back({model, rotation, beta, Cumulated::Auto, true, formulation});
    return list;
  }();
  return all;
}

// Calls f(body, name) for every irregular mesh and model, with small and with extreme deformations.
template <class F> void for_each_body(F&& f) {
  for (const double amount : {0.2, 2.0}) {
    for (const Elastic& recipe : recipes()) {
      for (NamedMap& each : irregular_maps()) {
        const auto body = elastic_body(std::move(each.map), recipe);
        meshes::shake(*body, amount, 9);
        f(*body, each.name + ", " + recipe.model + ", " + recipe.rotation);
      }
    }
  }
}

TEST(ElementKernel, gives_the_forces_of_the_law_and_of_a_walk) {
  for_each_body([](Body& body, const std::string& name) {
    SCOPED_TRACE(name);
    const std::size_t count = body.program->vertices(), corners = body.map->cells(body.mass->orbit()).slots();
    std::vector<Record> forces(count), sums(count), walked(count), corner(corners), walked_corner(corners);
    body.program->forces(positions(body), velocities(body), forces.data());
    body.program->corner_forces(positions(body), velocities(body), corner.data(), sums.data());
    walk_forces(*body.map, body.interactions, body.mass->orbit(), positions(body), velocities(body),
                walked_corner.data(), walked.data());
    EXPECT_GT(meshes::largest(walked), 1);
    EXPECT_LT(difference(forces, walked), 1e-12);
    EXPECT_LT(difference(sums, walked), 1e-12);
    EXPECT_LT(difference(corner, walked_corner), 1e-12);
    for (const Record& f : forces) EXPECT_EQ(f.w, 0);
  });
}

TEST(ElementKernel, agrees_with_the_plain_kernel_row_by_row) {
  for_each_body([](Body& body, const std::string& name) {
    SCOPED_TRACE(name);
    for (const Binder& binder : body.program->folded()) {
      const auto count = static_cast<std::uint32_t>(body.program->vertices());
      std::vector<Record> fast(count), plain(count);
      const auto run = [&](const Kernel& kernel, std::vector<Record>& force) {
        kernel.forces({*binder.interaction()->law, binder.rows(), positions(body), velocities(body),
                       body.map->rest().values().data(), force.data(), 0, count, 0, binder.rows().blocks(),
                       binder.interaction()->damped});
      };
      run(kernel_of(*binder.interaction()->law), fast);
      run(plain_kernel(), plain);
      if (!binder.interaction()->name.starts_with("enhanced") ||
          !binder.interaction()->name.ends_with("quad")) {
        EXPECT_NE(kernel_of(*binder.interaction()->law).forces, plain_kernel().forces);
      }
      EXPECT_LT(difference(fast, plain), 1e-12);
    }
  });
}

TEST(ElementKernel, gives_each_part_of_the_vertices_the_bytes_of_the_whole) {
  for_each_body([](Body& body, const std::string& name) {
    SCOPED_TRACE(name);
    for (const Binder& binder : body.program->folded()) {
      const auto count = static_cast<std::uint32_t>(body.program->vertices());
      std::vector<Record> whole(count), parts(count);
      const auto run = [&](std::vector<Record>& force, std::uint32_t low, std::uint32_t high) {
        kernel_of(*binder.interaction()->law)
            .forces({*binder.interaction()->law, binder.rows(), positions(body), velocities(body),
                     body.map->rest().values().data(), force.data(), low, high, 0, binder.rows().blocks(),
                     binder.interaction()->damped});
      };
      run(whole, 0, count);
      for (const auto& [low, high] : {std::pair{0u, 5u}, {5u, 6u}, {6u, 17u}, {17u, count}})
        run(parts, low, high);
      for (std::size_t n = 0; n < count; ++n) EXPECT_EQ(whole[n].vec(), parts[n].vec());
    }
  });
}

TEST(ElementKernel, is_finite_for_flat_collapsed_and_inverted_bodies_beside_padding) {
  for (const Elastic& recipe : recipes()) {
    for (NamedMap& each : irregular_maps()) {
      const auto body = elastic_body(std::move(each.map), recipe);
      for (const Vec3& scale : {Vec3(1, 1, 0), Vec3(0, 0, 1), Vec3(0, 0, 0), Vec3(-1, 1, 1)}) {
        auto& x = body->map->position().values();
        for (Slot v = 0; v < x.size(); ++v) x[v] = Record(scale.cwiseProduct(body->map->rest()[v].vec()));
        std::vector<Record> forces(x.size());
        body->program->forces(positions(*body), velocities(*body), forces.data());
        for (const Record& f : forces) EXPECT_TRUE(f.vec().allFinite()) << each.name << recipe.rotation;
      }
    }
  }
}

} // namespace
} // namespace rend::element_kernel_test
