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

// Along the edges of the triangles two columns each, at both heights of points; along the axis three, at the
// points of a triangle, whose shares of the corners are 2/3, 1/6, 1/6.
struct PrismLanes {
  static constexpr int N = 6, dim = 3, points = 6, columns_count = 7;
  static constexpr int column(int g, int axis) { return axis == 2 ? 4 + g % 3 : 2 * axis + g / 3; }
  static REND_INLINE void columns(const Vector* x, Vector* D) {
    for (int axis = 0; axis < 2; ++axis) {
      const Vector a = x[1 + axis] - x[0], b = x[4 + axis] - x[3];
      D[2 * axis] = splat(near_end) * a + splat(far_end) * b;
      D[2 * axis + 1] = splat(far_end) * a + splat(near_end) * b;
    }
    Vector up[3];
    for (int n = 0; n < 3; ++n) up[n] = x[3 + n] - x[n];
    shares(up, D + 4);
  }
  static REND_INLINE void corners(const Vector* H, Vector* f) {
    shares(H + 4, f);
    for (int n = 0; n < 3; ++n) f[3 + n] = Vector{} - f[n];
    for (int axis = 0; axis < 2; ++axis) {
      const Vector a = splat(near_end) * H[2 * axis] + splat(far_end) * H[2 * axis + 1];
      const Vector b = splat(far_end) * H[2 * axis] + splat(near_end) * H[2 * axis + 1];
      f[0] = f[0] + a;
      f[1 + axis] = f[1 + axis] - a;
      f[3] = f[3] + b;
      f[4 + axis] = f[4 + axis] - b;
    }
  }

private:
  // From values at the corners of a triangle to those at its points; equal to its transpose.
  static REND_INLINE void shares(const Vector* from, Vector* to) {
    const Vector sixth = splat(1.0 / 6) * (from[0] + from[1] + from[2]);
    for (int n = 0; n < 3; ++n) to[n] = sixth + splat(0.5) * from[n];
  }
};

// Along the edges of the base two columns each, as in a quad; towards the apex one at each point of the base.
struct PyramidLanes {
  static constexpr int N = 5, dim = 3, points = 4, columns_count = 8;
  static constexpr int column(int g, int axis) { return axis == 2 ? 4 + g : QuadLanes::column(g, axis); }
  static REND_INLINE void columns(const Vector* x, Vector* D) {
    QuadLanes::columns(x, D);
    const Vector base[4] = {x[0], x[1], x[3], x[2]}; // in the order of the points
    Vector at[4];
    HexahedronLanes::means(base, at);
    for (int g = 0; g < 4; ++g) D[4 + g] = x[4] - at[g];
  }
  static REND_INLINE void corners(const Vector* H, Vector* f) {
    QuadLanes::corners(H, f);
    Vector base[4];
    HexahedronLanes::means(H + 4, base);
    f[0] = f[0] + base[0];
    f[1] = f[1] + base[1];
    f[3] = f[3] + base[2];
    f[2] = f[2] + base[3];
    f[4] = Vector{} - (H[4] + H[5] + H[6] + H[7]);
  }
};

} // namespace rend::lanes
