#include "sim/rows/gathered_row.h"
#include "sim/rows/kernels.h"

#include <array>

namespace rend {
namespace {

// Calls f(row, forces of the unit's particles) for the rows of a block.
template <class F> void each_unit(const KernelArguments& a, std::size_t block, F&& f) {
  const std::size_t begin = a.rows.begin(block), end = begin + a.rows.rows_in(block);
  std::array<Vec3, most_particles> force;
  thread_local GatheredRow g;
  for (std::size_t at = begin; at < end; ++at) {
    g.take(a.law, a.rows, at, a.position, a.velocity, a.rest);
    a.law.forces(g.unit(), g.state(), force.data());
    f(at, force);
  }
}

void add(Record& to, const Vec3& force) {
  to = Record(to.vec() + force);
}

void forces(const KernelArguments& a) {
  for (std::size_t block = a.first; block < a.last; ++block) {
    const PackedRows::Range range = a.rows.range(block);
    if (range.low >= a.high || range.high < a.low) continue;
    each_unit(a, block, [&](std::size_t at, const auto& force) {
      for (int p = 0; p < a.law.particles(); ++p) {
        const std::uint32_t vertex = a.rows.index(p)[at];
        if (vertex >= a.low && vertex < a.high) add(a.force[vertex], force[static_cast<std::size_t>(p)]);
      }
    });
  }
}

void corner_forces(const KernelArguments& a) {
  const int particles = a.law.particles();
  for (std::size_t block = a.first; block < a.last; ++block)
    each_unit(a, block, [&](std::size_t at, const auto& force) {
      for (int p = 0; p < particles; ++p)
        add(a.force[a.rows.index(particles + p)[at]], force[static_cast<std::size_t>(p)]);
    });
}

} // namespace

Kernel plain_kernel() {
  return {[](const ForceLaw&) { return true; }, &forces, &corner_forces};
}

const Kernel& kernel_of(const ForceLaw& law) {
  static const std::array<Kernel, 5> kernels{spring_kernel(), hinge_kernel(), element_kernel(), tensor_kernel(),
                                             plain_kernel()};
  for (const Kernel& kernel : kernels)
    if (kernel.fits(law)) return kernel;
  return kernels.back();
}

} // namespace rend
