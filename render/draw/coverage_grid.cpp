#include "render/draw/coverage_grid.h"

#include <algorithm>
#include <cmath>

namespace rend {

CoverageGrid::CoverageGrid(int columns, int rows)
    : columns_(columns), rows_(rows), marked_(static_cast<std::size_t>(columns) * rows) {}

void CoverageGrid::clear() {
  std::fill(marked_.begin(), marked_.end(), 0);
}

void CoverageGrid::mark_all() {
  std::fill(marked_.begin(), marked_.end(), 1);
}

CoverageGrid::Range CoverageGrid::range(float low_x, float low_y, float high_x, float high_y) const {
  const auto square = [](float at, int most) { // clamped first: far coordinates would overflow an int
    return static_cast<int>(std::clamp(at, 0.0f, static_cast<float>(most)));
  };
  if (!(high_x >= 0 && high_y >= 0)) return {};
  return {square(low_x, columns_), std::min(square(high_x, columns_) + 1, columns_), square(low_y, rows_),
          std::min(square(high_y, rows_) + 1, rows_)};
}

void CoverageGrid::mark(float low_x, float low_y, float high_x, float high_y) {
  const Range in = range(low_x, low_y, high_x, high_y);
  for (int row = in.low; row < in.high; ++row)
    for (int column = in.left; column < in.right; ++column)
      marked_[static_cast<std::size_t>(row * columns_ + column)] = 1;
}

bool CoverageGrid::any(float low_x, float low_y, float high_x, float high_y) const {
  const Range in = range(low_x, low_y, high_x, high_y);
  for (int row = in.low; row < in.high; ++row)
    for (int column = in.left; column < in.right; ++column)
      if (at(column, row)) return true;
  return false;
}

PixelRect CoverageGrid::bounds() const {
  int left = columns_, right = 0, low = rows_, high = 0;
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) {
      if (!at(column, row)) continue;
      left = std::min(left, column);
      right = std::max(right, column + 1);
      low = std::min(low, row);
      high = row + 1;
    }
  return right > left ? PixelRect{left, low, right - left, high - low} : PixelRect{};
}

CoverageGrid blocks_of(int width, int height) {
  return {(width + block_side - 1) / block_side, (height + block_side - 1) / block_side};
}

void mark_covered(CoverageGrid& blocks, std::span<const Corner> corners, const View& view, int width,
                  int height) {
  Eigen::Matrix4d to_blocks = Eigen::Matrix4d::Identity();
  to_blocks(0, 0) = to_blocks(0, 3) = 0.5 * width / block_side;
  to_blocks(1, 1) = to_blocks(1, 3) = 0.5 * height / block_side;
  const Eigen::Matrix4f matrix = (to_blocks * view.world_to_clip()).cast<float>();
  const auto behind = static_cast<float>(1e-6 * view.distance);
  constexpr float margin = 1.0f / block_side; // a pixel, for rounding
  for (std::size_t n = 0; n + 2 < corners.size(); n += 3) {
    float low_x = 1e30f, low_y = 1e30f, high_x = -1e30f, high_y = -1e30f;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& p = corners[n + k].position;
      const Eigen::Vector4f clip =
          matrix.col(0) * p[0] + matrix.col(1) * p[1] + matrix.col(2) * p[2] + matrix.col(3);
      if (clip.w() < behind) return blocks.mark_all(); // crosses the plane of the eye: may project anywhere
      const float inverse = 1 / clip.w(), x = clip.x() * inverse, y = clip.y() * inverse;
      low_x = std::min(low_x, x);
      low_y = std::min(low_y, y);
      high_x = std::max(high_x, x);
      high_y = std::max(high_y, y);
    }
    blocks.mark(low_x - margin, low_y - margin, high_x + margin, high_y + margin);
  }
}

PixelRect pixels_of(const PixelRect& blocks, int width, int height) {
  const int x = blocks.x * block_side, y = blocks.y * block_side;
  return {x, y, std::min(blocks.width * block_side, width - x),
          std::min(blocks.height * block_side, height - y)};
}

std::vector<std::vector<PixelRect>> runs(int columns, int rows, int kinds,
                                         const std::function<int(int column, int row)>& kind) {
  std::vector<std::vector<PixelRect>> out(static_cast<std::size_t>(kinds));
  for (int row = 0; row < rows; ++row)
    for (int column = 0, before = -1; column < columns; ++column) {
      const int here = kind(column, row);
      std::vector<PixelRect>& boxes = out[static_cast<std::size_t>(here)];
      if (here == before)
        ++boxes.back().width;
      else
        boxes.push_back({column, row, 1, 1});
      before = here;
    }
  return out;
}

} // namespace rend
