#include "sim/solve/preconditioner.h"

#include "sim/program/threads.h"
#include "sim/solve/block_products.h"

#include <algorithm>

namespace rend {
namespace {

constexpr std::size_t range = 4096; // rows

// Calls f(begin, end) for every range of rows.
template <class F> void each_range(int parts, std::size_t rows, F&& f) {
  in_parts(parts, (rows + range - 1) / range, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) f(n * range, std::min(rows, (n + 1) * range));
  });
}

// The inverse of a symmetric block; false if it is not positive.
bool invert(const Block3& block, Block3& inverse) {
  const Eigen::Matrix3d m = block.matrix();
  Eigen::Matrix3d cofactor;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      cofactor(r, c) = m((r + 1) % 3, (c + 1) % 3) * m((r + 2) % 3, (c + 2) % 3) -
                       m((r + 1) % 3, (c + 2) % 3) * m((r + 2) % 3, (c + 1) % 3);
  const double determinant = m(0, 0) * cofactor(0, 0) + m(0, 1) * cofactor(0, 1) + m(0, 2) * cofactor(0, 2);
  if (!(m(0, 0) > 0 && cofactor(2, 2) > 0 && determinant > 1e-12 * m(0, 0) * m(1, 1) * m(2, 2))) return false;
  inverse = Block3::of(cofactor / determinant);
  return true;
}

} // namespace

void Preconditioner::shape() {
  const BlockPattern& p = *pattern_;
  start_.assign(1, 0);
  column_.clear();
  source_.clear();
  for (std::size_t i = 0; i < p.rows(); ++i) {
    const std::size_t first = i / range * range;
    for (std::size_t at = p.start[i]; at < p.diagonal[i]; ++at) {
      if (p.column[at] < first) continue;
      column_.push_back(p.column[at]);
      source_.push_back(static_cast<std::uint32_t>(at));
    }
    start_.push_back(static_cast<std::uint32_t>(column_.size()));
  }
  lower_.resize(column_.size());
  inverse_pivot_.resize(p.rows());
}

void Preconditioner::take(const BlockMatrix& matrix) {
  if (pattern_ != matrix.pattern()) {
    pattern_ = matrix.pattern();
    shape();
  }
  each_range(pattern_->parts, pattern_->rows(), [&](std::size_t begin, std::size_t end) {
    if (!factorise(matrix, begin, end)) take_diagonal(matrix, begin, end);
  });
}

void Preconditioner::take_diagonal(const BlockMatrix& matrix, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    if (!invert(matrix.diagonal(i), inverse_pivot_[i])) {
      inverse_pivot_[i] = Block3{};
      for (int axis = 0; axis < 3; ++axis)
        inverse_pivot_[i](axis, axis) = 1 / std::max(1e-300, std::abs(matrix.diagonal(i)(axis, axis)));
    }
    std::fill(lower_.begin() + start_[i], lower_.begin() + start_[i + 1], Block3{});
  }
}

// Row after row: Y_ij = A_ij − Σ_m Y_im L_jmᵀ over the columns m that rows i and j share, L_ij = Y_ij D_j⁻¹.
bool Preconditioner::factorise(const BlockMatrix& matrix, std::size_t begin, std::size_t end) {
  std::vector<Block3> work(end - begin);         // row i of Y
  std::vector<std::uint32_t> of(end - begin, 0); // row + 1 that the entry of work is of
  for (std::size_t i = begin; i < end; ++i) {
    Block3 diagonal = matrix.diagonal(i);
    for (std::size_t at = start_[i]; at < start_[i + 1]; ++at) {
      work[column_[at] - begin] = matrix.at(source_[at]);
      of[column_[at] - begin] = static_cast<std::uint32_t>(i + 1);
    }
    for (std::size_t at = start_[i]; at < start_[i + 1]; ++at) {
      const std::uint32_t j = column_[at];
      Block3& y = work[j - begin];
      for (std::size_t n = start_[j]; n < start_[j + std::size_t{1}]; ++n)
        if (of[column_[n] - begin] == i + 1) subtract_product(y, work[column_[n] - begin], lower_[n]);
      for (int c = 0; c < 3; ++c) store(lower_[at].column[c], times(y, inverse_pivot_[j].column[c]));
      subtract_product(diagonal, y, lower_[at]);
    }
    if (!invert(diagonal, inverse_pivot_[i])) return false;
  }
  return true;
}

namespace {

REND_CLONES void apply_rows(const std::vector<std::uint32_t>& start, const std::vector<std::uint32_t>& column,
                            const std::vector<Block3>& lower, const std::vector<Block3>& inverse_pivot,
                            std::size_t begin, std::size_t end, const Record* r, Record* z) {
  for (std::size_t i = begin; i < end; ++i) {
    Double4 first = load(r[i]), second{}, third{};
    for (std::size_t at = start[i]; at < start[i + 1]; ++at) {
      const Record& y = z[column[at]];
      first -= load(lower[at].column[0]) * splat(y.x);
      second += load(lower[at].column[1]) * splat(y.y);
      third += load(lower[at].column[2]) * splat(y.z);
    }
    store(z[i], first - (second + third));
  }
  for (std::size_t i = begin; i < end; ++i) store(z[i], times(inverse_pivot[i], z[i]));
  for (std::size_t i = end; i-- > begin;) {
    const Double4 x = load(z[i]);
    for (std::size_t at = start[i]; at < start[i + 1]; ++at) {
      const Block3& l = lower[at];
      Record& to = z[column[at]];
      store(to,
            load(to) - sums_of(load(l.column[0]) * x, load(l.column[1]) * x, load(l.column[2]) * x, Double4{}));
    }
  }
}

} // namespace

void Preconditioner::apply(const Record* r, Record* z) const {
  each_range(pattern_->parts, pattern_->rows(), [&](std::size_t begin, std::size_t end) {
    apply_rows(start_, column_, lower_, inverse_pivot_, begin, end, r, z);
  });
}

std::size_t Preconditioner::bytes() const {
  return (lower_.size() + inverse_pivot_.size()) * sizeof(Block3) +
         (start_.size() + 2 * column_.size()) * sizeof(std::uint32_t);
}

} // namespace rend
