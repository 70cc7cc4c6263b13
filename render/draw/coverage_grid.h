// Conservative coverage of a grid of squares: blocks of a picture that bodies may cover, parts of the floor
// that a shadow may reach. Squares that are certainly empty are skipped as a whole, without a test for each
// pixel.
#pragma once

#include "render/draw/camera.h"
#include "render/draw/frame.h"
#include "render/draw/pixel_rect.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace rend {

class CoverageGrid {
public:
  CoverageGrid(int columns, int rows);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  void clear();
  // Marks all squares that the rectangle touches, in units of squares; clipped to the grid.
  void mark(float low_x, float low_y, float high_x, float high_y);
  void mark_all();
  bool at(int column, int row) const { return marked_[static_cast<std::size_t>(row * columns_ + column)] != 0; }
  // Whether any of the squares that the rectangle touches is marked.
  bool any(float low_x, float low_y, float high_x, float high_y) const;
  // The bounding rectangle of the marked squares; width 0: there are none.
  PixelRect bounds() const;

private:
  struct Range {
    int left, right, low, high; // in squares; right and high are exclusive
  };
  Range range(float low_x, float low_y, float high_x, float high_y) const;

  int columns_, rows_;
  std::vector<std::uint8_t> marked_; // rows x columns, 1 or 0
};

constexpr int block_side = 32; // [pixels]
// Marks the blocks of a picture of that size that triangles (three corners each) may cover.
CoverageGrid blocks_of(int width, int height);
void mark_covered(CoverageGrid& blocks, std::span<const Corner> corners, const View& view, int width,
                  int height);

PixelRect pixels_of(const PixelRect& blocks, int width, int height); // in pixels, clipped to the picture

// Runs of adjacent squares of the same kind in a row, as rectangles of squares. kind: of (column, row), below
// `kinds`; one list for each kind.
std::vector<std::vector<PixelRect>> runs(int columns, int rows, int kinds,
                                         const std::function<int(int column, int row)>& kind);

} // namespace rend
