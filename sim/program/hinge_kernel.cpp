#include "sim/mechanics/hinge_law.h"
#include "sim/program/kernels.h"

namespace rend {
namespace {

constexpr int particles = particles_of(Law::Hinge);

// Calls f(row, forces of the eight) for the rows of a block.
template <class F> void each_hinge(const KernelArguments& a, std::size_t block, F&& f) {
  const std::size_t begin = block * PackedRows::block_size, end = begin + a.rows.rows_in(block);
  for (std::size_t at = begin; at < end; ++at) {
    HingePoints x, v;
    for (int p = 0; p < particles; ++p) {
      x[static_cast<std::size_t>(p)] = a.position[a.rows.index(p)[at]];
      v[static_cast<std::size_t>(p)] = a.velocity[a.rows.index(p)[at]];
    }
    f(at, hinge_forces({a.rows.value(0)[at], a.rows.value(1)[at], a.rows.value(2)[at]}, x, v));
  }
}

void add(Record& to, const Vec3& force) {
  to = Record(to.vec() + force);
}

} // namespace

void hinge_forces(const KernelArguments& a) {
  for (std::size_t block = a.first; block < a.last; ++block) {
    const PackedRows::Range range = a.rows.range(block);
    if (range.low >= a.high || range.high < a.low) continue;
    each_hinge(a, block, [&](std::size_t at, const HingePoints& force) {
      for (int p = 0; p < particles; ++p) {
        const std::uint32_t vertex = a.rows.index(p)[at];
        if (vertex >= a.low && vertex < a.high) add(a.force[vertex], force[static_cast<std::size_t>(p)]);
      }
    });
  }
}

void hinge_corner_forces(const KernelArguments& a) {
  for (std::size_t block = a.first; block < a.last; ++block)
    each_hinge(a, block, [&](std::size_t at, const HingePoints& force) {
      for (int p = 0; p < particles; ++p)
        add(a.force[a.rows.index(particles + p)[at]], force[static_cast<std::size_t>(p)]);
    });
}

} // namespace rend
