#include "sim/solve/block_factor.h"

#include "sim/base/bytes.h"
#include "sim/base/check.h"
#include "sim/base/stop_request.h"
#include "sim/solve/block_products.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

#include <cmath>

namespace rend {
namespace {

constexpr std::uint32_t none = ~std::uint32_t{0};
constexpr double least_pivot = 1e-13; // relative to the matrix's own diagonal: below, it is round-off

} // namespace

void BlockFactor::analyse(const std::shared_ptr<const BlockPattern>& pattern) {
  if (pattern_ == pattern) return;
  pattern_ = pattern;
  order_by_degree();
  shape();
}

void BlockFactor::order_by_degree() {
  const BlockPattern& p = *pattern_;
  const auto n = static_cast<int>(p.rows());
  Eigen::SparseMatrix<double> graph(n, n);
  graph.reserve(static_cast<Eigen::Index>(p.blocks()));
  for (int i = 0; i < n; ++i) {
    graph.startVec(i);
    for (std::size_t at = p.start[static_cast<std::size_t>(i)]; at < p.start[static_cast<std::size_t>(i) + 1];
         ++at)
      graph.insertBack(static_cast<int>(p.column[at]), i) = 1;
  }
  graph.finalize();
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(graph, order);
  order_.resize(p.rows());
  inverse_.resize(p.rows());
  for (std::uint32_t k = 0; k < order_.size(); ++k) {
    order_[k] = static_cast<std::uint32_t>(order.indices()[k]);
    inverse_[order_[k]] = k;
  }
}

// Elimination tree and counts of the columns.
void BlockFactor::shape() {
  const BlockPattern& p = *pattern_;
  const std::size_t n = p.rows();
  parent_.assign(n, none);
  mark_.assign(n, none);
  std::vector<std::size_t> count(n, 0);
  for (std::uint32_t k = 0; k < n; ++k) {
    mark_[k] = k;
    for (std::size_t at = p.start[order_[k]]; at < p.start[order_[k] + std::size_t{1}]; ++at) {
      for (std::uint32_t j = inverse_[p.column[at]]; j < k && mark_[j] != k; j = parent_[j]) {
        if (parent_[j] == none) parent_[j] = k;
        ++count[j];
        mark_[j] = k;
      }
    }
  }
  start_.assign(n + 1, 0);
  products_ = 0;
  for (std::size_t j = 0; j < n; ++j) {
    start_[j + 1] = start_[j] + count[j];
    products_ += 0.5 * static_cast<double>(count[j]) * static_cast<double>(count[j] + 3) + 1;
  }
  total_ = start_[n];
  lower_.clear();
  row_.clear();
}

namespace {

REND_INLINE Block3 product(const Block3& b, const Block3& c) {
  Block3 a;
  for (int n = 0; n < 3; ++n) store(a.column[n], times(b, c.column[n]));
  return a;
}

// One step of the elimination of row k: column j of L has `count` blocks above row k; `y` is the current value
// of (k, j); leaves L_kj.
REND_INLINE void eliminate(const Block3* column, const std::uint32_t* row, std::size_t count,
                           const Block3& pivot, Block3* work, const Block3& y, Block3& lower,
                           Block3& diagonal) {
  for (std::size_t n = 0; n < count; ++n) subtract_product(work[row[n]], y, column[n]);
  lower = product(y, pivot);
  subtract_product(diagonal, y, lower);
}

} // namespace

// Scatters row k of the matrix into work_ and lists the columns of row k of L in the order of elimination at
// the end of stack_; returns where they begin.
std::size_t BlockFactor::reach(std::uint32_t k, const BlockMatrix& matrix) {
  const BlockPattern& p = *pattern_;
  std::size_t top = p.rows();
  mark_[k] = k;
  for (std::size_t at = p.start[order_[k]]; at < p.start[order_[k] + std::size_t{1}]; ++at) {
    std::uint32_t j = inverse_[p.column[at]];
    if (j > k) continue;
    work_[j] = matrix.at(at);
    std::size_t length = 0;
    for (; mark_[j] != k; j = parent_[j]) {
      path_[length++] = j;
      mark_[j] = k;
    }
    while (length > 0) stack_[--top] = path_[--length];
  }
  return top;
}

int BlockFactor::invert(std::uint32_t k, const Block3& diagonal) {
  const Eigen::Matrix3d a = pivot_[k].matrix();
  Eigen::Matrix3d l = Eigen::Matrix3d::Identity();
  Vec3 d;
  for (int i = 0; i < 3; ++i) {
    double rest = a(i, i);
    for (int j = 0; j < i; ++j) {
      double sum = a(i, j);
      for (int m = 0; m < j; ++m) sum -= l(i, m) * d[m] * l(j, m);
      l(i, j) = sum / d[j];
      rest -= l(i, j) * l(i, j) * d[j];
    }
    if (!(std::abs(rest) > least_pivot * std::abs(diagonal(i, i)))) return 0;
    d[i] = rest;
  }
  Eigen::Matrix3d inverse = Eigen::Matrix3d::Identity(); // of l
  inverse(1, 0) = -l(1, 0);
  inverse(2, 1) = -l(2, 1);
  inverse(2, 0) = l(1, 0) * l(2, 1) - l(2, 0);
  Eigen::Matrix3d sum;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      sum(r, c) = inverse(0, r) * inverse(0, c) / d[0] + inverse(1, r) * inverse(1, c) / d[1] +
                  inverse(2, r) * inverse(2, c) / d[2];
  inverse_pivot_[k] = Block3::of(sum);
  return d.minCoeff() > 0 ? 1 : -1;
}

Definiteness BlockFactor::factorise(const BlockMatrix& matrix) {
  CHECK(matrix.pattern() == pattern_);
  const std::size_t n = pattern_->rows();
  lower_.resize(total_);
  row_.resize(total_);
  end_.assign(n, 0);
  pivot_.resize(n);
  inverse_pivot_.resize(n);
  work_.assign(n, Block3{});
  mark_.assign(n, none);
  stack_.resize(n);
  path_.resize(n);
  bool positive = true;
  for (std::uint32_t k = 0; k < n; ++k) {
    throw_if_stop_is_due();
    const std::size_t top = reach(k, matrix);
    Block3 diagonal = work_[k];
    work_[k] = Block3{};
    for (std::size_t at = top; at < n; ++at) {
      const std::uint32_t j = stack_[at];
      const Block3 y = work_[j];
      work_[j] = Block3{};
      const std::size_t place = start_[j] + end_[j];
      at_width<eliminate>(lower_.data() + start_[j], row_.data() + start_[j], end_[j], inverse_pivot_[j],
                          work_.data(), y, lower_[place], diagonal);
      row_[place] = k;
      ++end_[j];
    }
    pivot_[k] = diagonal;
    const int sign = invert(k, matrix.diagonal(order_[k]));
    if (sign == 0) return Definiteness::Singular;
    positive = positive && sign > 0;
  }
  return positive ? Definiteness::Positive : Definiteness::Indefinite;
}

namespace {

REND_INLINE void substitute(const std::vector<std::size_t>& start, const std::vector<std::uint32_t>& row,
                            const std::vector<Block3>& lower, const std::vector<Block3>& inverse_pivot,
                            Record* x) {
  const std::size_t n = inverse_pivot.size();
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t at = start[j]; at < start[j + 1]; ++at)
      store(x[row[at]], load(x[row[at]]) - times(lower[at], x[j]));
  for (std::size_t j = n; j-- > 0;) {
    Double4 sum = times(inverse_pivot[j], x[j]);
    for (std::size_t at = start[j]; at < start[j + 1]; ++at) {
      const Double4 y = load(x[row[at]]);
      const Block3& l = lower[at]; // its transpose is multiplied by y
      sum -= sums_of(load(l.column[0]) * y, load(l.column[1]) * y, load(l.column[2]) * y, Double4{});
    }
    store(x[j], sum);
  }
}

} // namespace

void BlockFactor::solve(const Record* b, Record* x) {
  const std::size_t n = pattern_->rows();
  solution_.resize(n);
  for (std::size_t k = 0; k < n; ++k) solution_[k] = b[order_[k]];
  at_width<substitute>(start_, row_, lower_, inverse_pivot_, solution_.data());
  for (std::size_t k = 0; k < n; ++k) x[order_[k]] = solution_[k];
}

std::size_t BlockFactor::bytes() const {
  std::size_t sum = bytes_of(start_) + bytes_of(solution_);
  for (const auto* one : {&order_, &inverse_, &parent_, &end_, &row_, &mark_, &stack_, &path_})
    sum += bytes_of(*one);
  for (const auto* one : {&lower_, &pivot_, &inverse_pivot_, &work_}) sum += bytes_of(*one);
  return sum;
}

} // namespace rend
