// Shape functions of the elements of mechanics/element.h, four elements at a time: from corners to Σ x_n ∇̂N_nᵀ
// at each integration point, and the transpose.
//
// The derivative along one reference axis is the same at several points (along ξ of a hexahedron it does not
// depend on ξ): such columns are computed once, and in the transpose their factors are summed first. The 24
// columns of a hexahedron become 12, each an average of four edges: half the work of 8 × 8 gradients.
//
//   columns(x, D)   D[k] = Σ c_kn x_n,   x relative to corner 0
//   corners(H, f)   f_n = −Σ c_kn H[k]
//   column(g, axis) index k of the column at point g
#pragma once

#include "sim/mechanics/element.h"
#include "sim/rows/lanes.h"

namespace rend::lanes {

template <int Dim> struct SimplexLanes {
  static constexpr int N = Dim + 1, dim = Dim, points = 1, columns_count = Dim;
  static constexpr int column(int, int axis) { return axis; }
  static REND_INLINE void columns(const Vector* x, Vector* D) {
    for (int axis = 0; axis < Dim; ++axis) D[axis] = x[axis + 1];
  }
  static REND_INLINE void corners(const Vector* H, Vector* f) {
    f[0] = H[0] + H[1];
    if constexpr (Dim == 3) f[0] = f[0] + H[2];
    for (int axis = 0; axis < Dim; ++axis) f[axis + 1] = {-H[axis].x, -H[axis].y, -H[axis].z};
  }
};

constexpr double near_end = 0.78867513459481288225, far_end = 0.21132486540518711775; // (1 ± 1/√3)/2

// Along each axis two edges; the column at a point is a weighted average of them.
struct QuadLanes {
  static constexpr int N = 4, dim = 2, points = 4, columns_count = 4;
  static constexpr int column(int g, int axis) { return axis == 0 ? g >> 1 : 2 + (g & 1); }
  static constexpr int edge[4][2] = {{0, 1}, {3, 2}, {0, 3}, {1, 2}}; // two along ξ, two along η
  static REND_INLINE void columns(const Vector* x, Vector* D) {
    for (int k = 0; k < 4; k += 2) {
      const Vector a = x[edge[k][1]] - x[edge[k][0]], b = x[edge[k + 1][1]] - x[edge[k + 1][0]];
      D[k] = splat(near_end) * a + splat(far_end) * b;
      D[k + 1] = splat(far_end) * a + splat(near_end) * b;
    }
  }
  static REND_INLINE void corners(const Vector* H, Vector* f) {
    for (int n = 0; n < N; ++n) f[n] = Vector{};
    for (int k = 0; k < 4; k += 2) {
      const Vector a = splat(near_end) * H[k] + splat(far_end) * H[k + 1];
      const Vector b = splat(far_end) * H[k] + splat(near_end) * H[k + 1];
      f[edge[k][0]] = f[edge[k][0]] + a;
      f[edge[k][1]] = f[edge[k][1]] - a;
      f[edge[k + 1][0]] = f[edge[k + 1][0]] + b;
      f[edge[k + 1][1]] = f[edge[k + 1][1]] - b;
    }
  }
};

// Along each axis four edges, in the order of the bits of the two other axes.
struct HexahedronLanes {
  static constexpr int N = 8, dim = 3, points = 8, columns_count = 12;
  static constexpr int column(int g, int axis) {
    return 4 * axis + (axis == 0 ? g >> 1 : axis == 1 ? (g & 1) + (g >> 2) * 2 : g & 3);
  }
  static constexpr int edge[12][2] = {{0, 1}, {3, 2}, {4, 5}, {7, 6}, {0, 3}, {1, 2},
                                      {4, 7}, {5, 6}, {0, 4}, {1, 5}, {3, 7}, {2, 6}};
  // From four values to their averages at the four Gauss points; equal to its transpose.
  static REND_INLINE void means(const Vector* from, Vector* to) {
    const Vector a = splat(near_end) * from[0] + splat(far_end) * from[1];
    const Vector b = splat(far_end) * from[0] + splat(near_end) * from[1];
    const Vector c = splat(near_end) * from[2] + splat(far_end) * from[3];
    const Vector d = splat(far_end) * from[2] + splat(near_end) * from[3];
    to[0] = splat(near_end) * a + splat(far_end) * c;
    to[1] = splat(near_end) * b + splat(far_end) * d;
    to[2] = splat(far_end) * a + splat(near_end) * c;
    to[3] = splat(far_end) * b + splat(near_end) * d;
  }
  static REND_INLINE void columns(const Vector* x, Vector* D) {
    for (int k = 0; k < 12; k += 4) {
      Vector along[4];
      for (int e = 0; e < 4; ++e) along[e] = x[edge[k + e][1]] - x[edge[k + e][0]];
      means(along, D + k);
    }
  }
  static REND_INLINE void corners(const Vector* H, Vector* f) {
    for (int n = 0; n < N; ++n) f[n] = Vector{};
    for (int k = 0; k < 12; k += 4) {
      Vector along[4];
      means(H + k, along);
      for (int e = 0; e < 4; ++e) {
        f[edge[k + e][0]] = f[edge[k + e][0]] + along[e];
        f[edge[k + e][1]] = f[edge[k + e][1]] - along[e];
      }
    }
  }
};

// Any kind of element, column by column from the table of its shape functions.
template <ElementKind kind, int Corners, int Points> struct TableLanes {
  static constexpr int N = Corners, dim = 3, points = Points, columns_count = 3 * Points;
  static constexpr int column(int g, int axis) { return 3 * g + axis; }
  static double coefficient(int k, int n) {
    static const ElementShape& shape = shape_of(kind);
    return shape.points[static_cast<std::size_t>(k / 3)]
        .gradient[static_cast<std::size_t>(n)][static_cast<std::size_t>(k % 3)];
  }
  static REND_INLINE void columns(const Vector* x, Vector* D) {
    for (int k = 0; k < columns_count; ++k) {
      D[k] = splat(coefficient(k, 1)) * x[1];
      for (int n = 2; n < N; ++n) D[k] = D[k] + splat(coefficient(k, n)) * x[n];
    }
  }
  static REND_INLINE void corners(const Vector* H, Vector* f) {
    for (int n = 0; n < N; ++n) {
      f[n] = splat(-coefficient(0, n)) * H[0];
      for (int k = 1; k < columns_count; ++k) f[n] = f[n] - splat(coefficient(k, n)) * H[k];
    }
  }
};

} // namespace rend::lanes
