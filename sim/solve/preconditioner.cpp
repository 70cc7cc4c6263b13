#include "sim/solve/preconditioner.h"

#include "sim/base/threads.h"
#include "sim/solve/block_products.h"
#include "sim/solve/vertex_order.h"

#include <algorithm>
#include <atomic>

namespace rend {
namespace {

constexpr std::size_t range = 4096; // rows
constexpr double most_taken = 1;    // the initial ω
constexpr double least_left = 0.6;  // the share of A_ii that D_i must keep

// Calls f(begin, end) for every range of rows.
template <class F> void each_range(int parts, std::size_t rows, F&& f) {
  parallel_ranges(parts, (rows + range - 1) / range, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) f(n * range, std::min(rows, (n + 1) * range));
  });
}

// The inverse of a symmetric block; false if it is not positive definite.
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
  order_ = vertex_order(p);
  std::vector<std::uint32_t> place(p.rows());
  for (std::uint32_t k = 0; k < order_.size(); ++k) place[order_[k]] = k;
  for (Part* part : {&lower_, &upper_, &coupling_}) *part = Part{{0}, {}, {}, {}, {}};
  std::vector<std::pair<std::uint32_t, std::uint32_t>> row; // column, source
  for (std::size_t k = 0; k < p.rows(); ++k) {
    row.clear();
    for (std::uint32_t at = p.start[order_[k]]; at < p.start[order_[k] + std::size_t{1}]; ++at)
      row.emplace_back(place[p.column[at]], at);
    std::sort(row.begin(), row.end());
    for (const auto& [column, source] : row) {
      if (column == k) continue;
      Part& part = column / range != k / range ? coupling_ : column < k ? lower_ : upper_;
      part.column.push_back(column);
      part.source.push_back(source);
    }
    for (Part* part : {&lower_, &upper_, &coupling_})
      part->start.push_back(static_cast<std::uint32_t>(part->column.size()));
  }
}

void Preconditioner::Part::copy(const BlockMatrix& matrix, std::size_t row, Precision precision) {
  for (std::size_t at = start[row]; at < start[row + 1]; ++at) {
    const Block3& b = matrix.at(source[at]);
    if (precision == Precision::Double)
      wide[at] = b;
    else
      for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 4; ++r) narrow[at].column[c][r] = static_cast<float>((&b.column[c].x)[r]);
  }
}

bool Preconditioner::set_matrix(const BlockMatrix& matrix, Precision precision) {
  if (pattern_ != matrix.pattern()) {
    pattern_ = matrix.pattern();
    shape();
  }
  precision_ = precision;
  for (Part* part : {&lower_, &upper_, &coupling_}) {
    part->wide.resize(precision == Precision::Double ? part->column.size() : 0);
    part->narrow.resize(precision == Precision::Single ? part->column.size() : 0);
  }
  for (auto* each : {&pivot_, &inverse_pivot_, &gap_}) each->resize(pattern_->rows());
  std::atomic<bool> positive = true;
  each_range(pattern_->parts, pattern_->rows(), [&](std::size_t begin, std::size_t end) {
    if (!factorise(matrix, begin, end)) positive = false;
  });
  return positive;
}

// D = A − ω sum, with ω halved until D keeps its share; false if A itself is not positive definite.
bool Preconditioner::choose_pivot(std::size_t i, const Block3& own, const Block3& sum) {
  Block3 inverse;
  double share = most_taken;
  for (int n = 0; n < 4; ++n, share *= 0.5) {
    for (int c = 0; c < 3; ++c) {
      const Double4 a = load(own.column[c]), without = a + share * load(sum.column[c]);
      store(pivot_[i].column[c], without);
      store(gap_[i].column[c], without - least_left * a);
    }
    if (invert(gap_[i], inverse)) return invert(pivot_[i], inverse_pivot_[i]);
  }
  pivot_[i] = own;
  return invert(own, inverse_pivot_[i]);
}

bool Preconditioner::factorise(const BlockMatrix& matrix, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    for (Part* part : {&lower_, &upper_, &coupling_}) part->copy(matrix, i, precision_);
    const Block3& own = matrix.diagonal(order_[i]);
    Block3 sum{}; // −Σ A_ij D_j⁻¹ A_ji
    for (std::size_t at = lower_.start[i]; at < lower_.start[i + 1]; ++at) {
      const Block3& a = matrix.at(lower_.source[at]);
      const Block3& inverse = inverse_pivot_[lower_.column[at]];
      Block3 y;
      for (int c = 0; c < 3; ++c) store(y.column[c], times(a, inverse.column[c]));
      subtract_product(sum, y, a);
    }
    if (!choose_pivot(i, own, sum)) return false;
    for (int c = 0; c < 3; ++c) store(gap_[i].column[c], load(own.column[c]) - 2.0 * load(pivot_[i].column[c]));
  }
  return true;
}

namespace {

using Float4 = float __attribute__((vector_size(16)));

REND_INLINE Double4 column_of(const Block3& b, int c) {
  return load(b.column[c]);
}
REND_INLINE Double4 column_of(const Preconditioner::Narrow& b, int c) {
  Float4 four;
  __builtin_memcpy(&four, b.column[c], sizeof four);
  return __builtin_convertvector(four, Double4);
}

REND_INLINE Double4 times(const Block3& b, Double4 x) {
  return load(b.column[0]) * splat(x[0]) + load(b.column[1]) * splat(x[1]) + load(b.column[2]) * splat(x[2]);
}

// sum − Σ B_ij x_j over row i.
template <class Block>
REND_INLINE Double4 without(Double4 sum, const Preconditioner::Part& part, const Block* value, std::size_t i,
                            const Record* x) {
  Double4 second{}, third{};
  for (std::size_t at = part.start[i]; at < part.start[i + 1]; ++at) {
    const Record& y = x[part.column[at]];
    sum -= column_of(value[at], 0) * splat(y.x);
    second += column_of(value[at], 1) * splat(y.y);
    third += column_of(value[at], 2) * splat(y.z);
  }
  return sum - (second + third);
}

// y = (D + L)⁻¹ r
template <class Block>
REND_INLINE void down(const Preconditioner::Part& lower, const Block* value, const Block3* inverse,
                      std::size_t begin, std::size_t end, const Record* r, Record* y) {
  for (std::size_t i = begin; i < end; ++i)
    store(y[i], times(inverse[i], without(load(r[i]), lower, value, i, y)));
}

// t = (D + Lᵀ)⁻¹ p, rest = p + gap t
template <class Block>
REND_INLINE void up(const Preconditioner::Part& upper, const Block* value, const Block3* inverse,
                    const Block3* gap, std::size_t begin, std::size_t end, const Record* p, Record* t,
                    Record* rest) {
  for (std::size_t i = end; i-- > begin;) {
    const Double4 x = times(inverse[i], without(load(p[i]), upper, value, i, t));
    store(t[i], x);
    store(rest[i], load(p[i]) + times(gap[i], x));
  }
}

// y = (D + L)⁻¹ (image + C t), image = t + y
template <class Block>
REND_INLINE void down_and_add(const Preconditioner::Part& lower, const Block* value,
                              const Preconditioner::Part& across, const Block* beyond, const Block3* inverse,
                              std::size_t begin, std::size_t end, const Record* t, Record* y, Record* image) {
  for (std::size_t i = begin; i < end; ++i) {
    const Double4 rest = load(image[i]) - without(Double4{}, across, beyond, i, t);
    const Double4 x = times(inverse[i], without(rest, lower, value, i, y));
    store(y[i], x);
    store(image[i], load(t[i]) + x);
  }
}

} // namespace

void Preconditioner::forward(std::size_t begin, std::size_t end, const Record* r, Record* y) const {
  if (precision_ == Precision::Single)
    at_width<down<Narrow>>(lower_, lower_.narrow.data(), inverse_pivot_.data(), begin, end, r, y);
  else
    at_width<down<Block3>>(lower_, lower_.wide.data(), inverse_pivot_.data(), begin, end, r, y);
}

void Preconditioner::backward(std::size_t begin, std::size_t end, const Record* p, Record* t,
                              Record* rest) const {
  if (precision_ == Precision::Single)
    at_width<up<Narrow>>(upper_, upper_.narrow.data(), inverse_pivot_.data(), gap_.data(), begin, end, p, t,
                         rest);
  else
    at_width<up<Block3>>(upper_, upper_.wide.data(), inverse_pivot_.data(), gap_.data(), begin, end, p, t,
                         rest);
}

void Preconditioner::finish(std::size_t begin, std::size_t end, const Record* t, Record* y,
                            Record* image) const {
  if (precision_ == Precision::Single)
    at_width<down_and_add<Narrow>>(lower_, lower_.narrow.data(), coupling_, coupling_.narrow.data(),
                                   inverse_pivot_.data(), begin, end, t, y, image);
  else
    at_width<down_and_add<Block3>>(lower_, lower_.wide.data(), coupling_, coupling_.wide.data(),
                                   inverse_pivot_.data(), begin, end, t, y, image);
}

void Preconditioner::forward(const Records& r, Records& y) const {
  each_range(pattern_->parts, r.size(),
             [&](std::size_t begin, std::size_t end) { forward(begin, end, r.data(), y.data()); });
}

void Preconditioner::product(const Records& p, Records& t, Records& image) {
  work_.resize(p.size());
  each_range(pattern_->parts, p.size(), [&](std::size_t begin, std::size_t end) {
    backward(begin, end, p.data(), t.data(), image.data());
  });
  each_range(pattern_->parts, p.size(), [&](std::size_t begin, std::size_t end) {
    finish(begin, end, t.data(), work_.data(), image.data());
  });
}

std::size_t Preconditioner::Part::bytes() const {
  return (start.size() + 2 * column.size()) * sizeof(std::uint32_t) + wide.size() * sizeof(Block3) +
         narrow.size() * sizeof(Narrow);
}

std::size_t Preconditioner::bytes() const {
  return lower_.bytes() + upper_.bytes() + coupling_.bytes() + 3 * pivot_.size() * sizeof(Block3) +
         order_.size() * sizeof(std::uint32_t) + work_.size() * sizeof(Record);
}

} // namespace rend
