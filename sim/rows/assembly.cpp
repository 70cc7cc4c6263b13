#include "sim/rows/assembly.h"

#include "sim/base/check.h"
#include "sim/base/threads.h"
#include "sim/rows/gathered_row.h"

namespace rend {

Assembly::Assembly(const EmbeddedMap& map, const Program& program) : map_(&map), program_(&program) {
  rebind();
}

namespace {

// Calls f(binder's rows, particles, row) for every row of every binder.
template <class F> void each_row(const std::vector<Binder>& binders, F&& f) {
  for (std::size_t n = 0; n < binders.size(); ++n) {
    const int particles = binders[n].interaction()->law->particles();
    binders[n].rows().for_each([&](std::size_t, std::size_t row) { f(n, particles, row); });
  }
}

BlockPattern pattern_of(const std::vector<Binder>& binders, std::size_t vertices) {
  std::vector<std::uint32_t> starts(vertices + 1, 0);
  const auto vertex = [&](std::size_t n, int p, std::size_t row) { return binders[n].rows().index(p)[row]; };
  each_row(binders, [&](std::size_t n, int particles, std::size_t row) {
    for (int p = 0; p < particles; ++p)
      starts[vertex(n, p, row) + std::size_t{1}] += static_cast<std::uint32_t>(particles);
  });
  for (std::size_t i = 0; i < vertices; ++i) starts[i + 1] += starts[i];
  std::vector<std::uint32_t> neighbours(starts.back()), end(starts.begin(), starts.end() - 1);
  each_row(binders, [&](std::size_t n, int particles, std::size_t row) {
    for (int p = 0; p < particles; ++p)
      for (int q = 0; q < particles; ++q) neighbours[end[vertex(n, p, row)]++] = vertex(n, q, row);
  });
  return BlockPattern::of(starts, neighbours);
}

} // namespace

// A product takes 1.5 ns per block; waking other threads takes up to ten microseconds each time, or until other
// programs release their processors: with fewer rows, a product was ten times slower on a busy machine.
constexpr std::size_t least_shared = 32768; // rows

void Assembly::rebind() {
  const std::vector<Binder>& binders = program_->rows();
  BlockPattern pattern = pattern_of(binders, program_->vertices());
  pattern.parts = pattern.rows() < least_shared ? 1 : program_->parts();
  if (!pattern_ || !pattern_->same_as(pattern) || pattern_->parts != pattern.parts)
    pattern_ = std::make_shared<const BlockPattern>(std::move(pattern));
  place_.resize(binders.size());
  for (std::size_t n = 0; n < binders.size(); ++n) {
    const int particles = binders[n].interaction()->law->particles();
    const auto blocks = static_cast<std::size_t>(particles * particles);
    const PackedRows& rows = binders[n].rows();
    place_[n].assign(rows.end() * blocks, 0);
    rows.for_each([&](std::size_t, std::size_t row) {
      std::uint32_t* place = place_[n].data() + row * blocks;
      for (int p = 0; p < particles; ++p)
        for (int q = 0; q < particles; ++q) *place++ = pattern_->place(rows.index(p)[row], rows.index(q)[row]);
    });
  }
}

namespace {

REND_INLINE void add_block(const UnitMatrix& unit, int p, int q, Block3& to) {
  for (int c = 0; c < 3; ++c) {
    const double* from = &unit.coeffRef(3 * p, 3 * q + c); // columns are contiguous
    Record& column = to.column[c];
    column.x += from[0];
    column.y += from[1];
    column.z += from[2];
  }
}

} // namespace

void Assembly::add_rows(std::size_t binder, const Record* x, const Record* v, Tangent tangent, Scales scales,
                        std::size_t low, std::size_t high, BlockMatrix& out) const {
  const Interaction& interaction = *program_->rows()[binder].interaction();
  const PackedRows& rows = program_->rows()[binder].rows();
  const ForceLaw& law = *interaction.law;
  const int particles = law.particles();
  const Record* rest = map_->rest().values().data();
  thread_local GatheredRow g;
  thread_local UnitMatrix by_position, by_velocity;
  for (std::size_t block = 0; block < rows.blocks(); ++block) {
    const PackedRows::Range range = rows.range(block);
    if (range.low >= high || range.high < low) continue;
    const std::size_t begin = rows.begin(block);
    for (std::size_t row = begin; row < begin + rows.rows_in(block); ++row) {
      const auto owned = [&](int p) { return rows.index(p)[row] >= low && rows.index(p)[row] < high; };
      bool any = false;
      for (int p = 0; p < particles; ++p) any = any || owned(p);
      if (!any) continue;
      g.take(law, rows, row, x, v, rest);
      law.stiffness(g.unit(), g.state(), tangent, by_position, by_velocity);
      by_position *= scales.position;
      if (interaction.damped && scales.velocity != 0) by_position += scales.velocity * by_velocity;
      if (tangent == Tangent::Exact) {
        by_velocity = 0.5 * (by_position + by_position.transpose());
        by_position = by_velocity;
      }
      const std::uint32_t* place =
          place_[binder].data() + row * static_cast<std::size_t>(particles * particles);
      for (int p = 0; p < particles; ++p) {
        if (owned(p))
          for (int q = 0; q < particles; ++q) add_block(by_position, p, q, out.at(place[q]));
        place += particles;
      }
    }
  }
}

void Assembly::add(const Record* position, const Record* velocity, Tangent tangent, double by_position,
                   double by_velocity, BlockMatrix& out) const {
  CHECK(out.pattern() == pattern_);
  parallel_ranges(program_->parts(), pattern_->rows(), [&](std::size_t low, std::size_t high) {
    for (std::size_t n = 0; n < place_.size(); ++n)
      add_rows(n, position, velocity, tangent, {by_position, by_velocity}, low, high, out);
  });
}

std::size_t Assembly::bytes() const {
  std::size_t total = pattern_->bytes();
  for (const auto& places : place_) total += places.size() * sizeof(std::uint32_t);
  return total;
}

} // namespace rend
