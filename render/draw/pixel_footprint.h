// Which squares of a grid something can touch: blocks of a picture that bodies cover, parts of the floor that a
// shadow may reach. What is certain to be empty is then not looked at, at a square's cost and not at each of
// its pixels.
#pragma once

#include "render/draw/camera.h"
#include "render/draw/frame.h"
#include "render/draw/pixel_box.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace rend {

class Footprint {
public:
  Footprint(int columns, int rows);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  void clear();
  // All squares that the rectangle touches, in units of squares; what of it lies beyond the grid is left out.
  void mark(float low_x, float low_y, float high_x, float high_y);
  void mark_all();
  bool at(int column, int row) const { return marked_[static_cast<std::size_t>(row * columns_ + column)] != 0; }
  // Whether any of the squares that the rectangle touches is marked.
  bool any(float low_x, float low_y, float high_x, float high_y) const;
  // The least rectangle of squares that holds the marks; width 0: there are none.
  PixelBox bounds() const;

private:
  struct Range {
    int left, right, low, high; // squares, right and high not among them
  };
  Range range(float low_x, float low_y, float high_x, float high_y) const;

  int columns_, rows_;
  std::vector<std::uint8_t> marked_; // rows x columns, 1 or 0
};

constexpr int block_side = 32; // [pixels]
// Blocks of a picture of that size that triangles (three corners each) can cover are marked; it has as many as
// are needed.
Footprint blocks_of(int width, int height);
void mark_covered(Footprint& blocks, std::span<const Corner> corners, const View& view, int width, int height);

PixelBox box_of(const PixelBox& blocks, int width, int height); // their pixels

// Neighbours of one kind in a row of squares, as one box of squares. kind: of (column, row), below `kinds`; one
// list each.
std::vector<std::vector<PixelBox>> runs(int columns, int rows, int kinds,
                                        const std::function<int(int column, int row)>& kind);

} // namespace rend
