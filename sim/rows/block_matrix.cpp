#include "sim/rows/block_matrix.h"

#include "sim/base/check.h"
#include "sim/base/threads.h"

#include <algorithm>

namespace rend {

BlockPattern BlockPattern::of(const std::vector<std::uint32_t>& starts,
                              const std::vector<std::uint32_t>& neighbours) {
  BlockPattern p;
  const std::size_t rows = starts.size() - 1;
  p.start.reserve(rows + 1);
  p.diagonal.reserve(rows);
  std::vector<std::uint32_t> seen(rows, 0); // last row + 1 that contained each column
  std::vector<std::uint32_t> row;
  for (std::size_t i = 0; i < rows; ++i) {
    const auto self = static_cast<std::uint32_t>(i);
    row.assign(1, self);
    seen[i] = self + 1;
    for (std::size_t n = starts[i]; n < starts[i + 1]; ++n) {
      const std::uint32_t j = neighbours[n];
      if (seen[j] == self + 1) continue;
      seen[j] = self + 1;
      row.push_back(j);
    }
    std::sort(row.begin(), row.end());
    const auto at = std::lower_bound(row.begin(), row.end(), self) - row.begin();
    p.start.push_back(static_cast<std::uint32_t>(p.column.size()));
    p.diagonal.push_back(static_cast<std::uint32_t>(p.column.size() + static_cast<std::size_t>(at)));
    p.column.insert(p.column.end(), row.begin(), row.end());
  }
  p.start.push_back(static_cast<std::uint32_t>(p.column.size()));
  return p;
}

std::uint32_t BlockPattern::place(std::uint32_t row, std::uint32_t col) const {
  const auto begin = column.begin() + start[row], end = column.begin() + start[row + 1];
  const auto at = std::lower_bound(begin, end, col);
  CHECK(at != end && *at == col);
  return static_cast<std::uint32_t>(at - column.begin());
}

std::size_t BlockPattern::bytes() const {
  return (start.size() + column.size() + diagonal.size()) * sizeof(std::uint32_t);
}

bool BlockPattern::same_as(const BlockPattern& other) const {
  return start == other.start && column == other.column && diagonal == other.diagonal;
}

Eigen::Matrix3d Block3::matrix() const {
  Eigen::Matrix3d m;
  for (int c = 0; c < 3; ++c) m.col(c) = column[c].vec();
  return m;
}

Block3 Block3::of(const Eigen::Matrix3d& matrix) {
  Block3 b;
  for (int c = 0; c < 3; ++c) b.column[c] = Record(Vec3(matrix.col(c)));
  return b;
}

void BlockMatrix::reset(std::shared_ptr<const BlockPattern> pattern) {
  pattern_ = std::move(pattern);
  value_.assign(pattern_->blocks(), Block3{});
}

void BlockMatrix::add_diagonal(std::size_t row, double s) {
  Block3& b = value_[pattern_->diagonal[row]];
  for (int axis = 0; axis < 3; ++axis) b(axis, axis) += s;
}

namespace {

REND_INLINE void multiply_rows(const BlockPattern& p, const Block3* value, std::size_t begin, std::size_t end,
                               const Record* x, Record* y) {
  for (std::size_t i = begin; i < end; ++i) {
    Double4 first{}, second{}, third{};
    for (std::size_t n = p.start[i]; n < p.start[i + 1]; ++n) {
      const Record& r = x[p.column[n]];
      first += load(value[n].column[0]) * splat(r.x);
      second += load(value[n].column[1]) * splat(r.y);
      third += load(value[n].column[2]) * splat(r.z);
    }
    store(y[i], (first + second) + third);
  }
}

} // namespace

void BlockMatrix::multiply(const Record* x, Record* y) const {
  parallel_ranges(pattern_->parts, rows(), [&](std::size_t begin, std::size_t end) {
    at_width<multiply_rows>(*pattern_, value_.data(), begin, end, x, y);
  });
}

void BlockMatrix::constrain(const std::uint8_t* axes) {
  parallel_ranges(pattern_->parts, rows(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t n = pattern_->start[i]; n < pattern_->start[i + 1]; ++n) {
        const std::uint8_t rows_held = axes[i], columns_held = axes[pattern_->column[n]];
        if ((rows_held | columns_held) == 0) continue;
        const bool own = pattern_->column[n] == i;
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c)
            if ((rows_held >> r & 1) || (columns_held >> c & 1)) value_[n](r, c) = own && r == c ? 1 : 0;
      }
    }
  });
}

} // namespace rend
