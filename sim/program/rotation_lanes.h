// The rotations of mechanics/rotation.h, of four elements at once.
//
// Lanes where the short way does not lead there (flat, inverted) are left to the reference, one by one; rows of padding,
// whose weight is 0, get none. What a lane becomes never depends on the others: those that have arrived stand still.
#pragma once

#include "sim/mechanics/rotation.h"
#include "sim/program/lanes.h"

namespace rend::lanes {

template <int Columns> void write_lane(Matrix<Columns>& R, int lane, const Eigen::Matrix3d& value) {
  for (int c = 0; c < Columns; ++c) {
    R.column[c].x[lane] = value(0, c);
    R.column[c].y[lane] = value(1, c);
    R.column[c].z[lane] = value(2, c);
  }
}

template <int Columns> Eigen::Matrix3d read_lane(const Matrix<Columns>& F, int lane) {
  Eigen::Matrix3d value = Eigen::Matrix3d::Zero();
  for (int c = 0; c < Columns; ++c)
    value.col(c) = Vec3(F.column[c].x[lane], F.column[c].y[lane], F.column[c].z[lane]);
  return value;
}

// One lane by the reference, or none (0) for padding.
template <Rotation rotation, int Columns>
[[gnu::noinline]] void turn_lane(Matrix<Columns>& R, const Matrix<Columns>& F, const Double4& weight,
                                 int lane) {
  const Eigen::Matrix3d f = read_lane(F, lane);
  if (weight[lane] == 0)
    write_lane(R, lane, Eigen::Matrix3d::Zero());
  else if (rotation == Rotation::Qr)
    write_lane(R, lane, gram_schmidt(f, Columns));
  else
    write_lane(R, lane, Columns == 3 ? closest_rotation(f) : closest_sheet_rotation(f));
}

REND_INLINE bool all(const Long4& mask) {
  return (mask[0] & mask[1] & mask[2] & mask[3]) != 0;
}

// Returns the lanes that are done.
REND_INLINE Long4 gram_schmidt_lanes(const Matrix<3>& F, Matrix<3>& R) {
  const Vector &f0 = F.column[0], &f1 = F.column[1];
  const Double4 s0 = dot(f0, f0), s1 = dot(f1, f1), s2 = dot(F.column[2], F.column[2]);
  const Double4 i0 = 1.0 / square_root(s0);
  R.column[0] = i0 * f0;
  const Vector rest = f1 - dot(R.column[0], f1) * R.column[0];
  const Double4 s = dot(rest, rest), i1 = 1.0 / square_root(s);
  R.column[1] = i1 * rest;
  R.column[2] = cross(R.column[0], R.column[1]);
  const Double4 least = 1e-24 * (s0 + s1 + s2);
  return (s0 > least) & (s > 1e-6 * s1); // nearer to a line it needs a second pass
}

REND_INLINE Long4 gram_schmidt_lanes(const Matrix<2>& F, Matrix<2>& R) {
  const Vector &f0 = F.column[0], &f1 = F.column[1];
  const Double4 s0 = dot(f0, f0), s1 = dot(f1, f1), i0 = 1.0 / square_root(s0);
  R.column[0] = i0 * f0;
  const Vector rest = f1 - dot(R.column[0], f1) * R.column[0];
  const Double4 s = dot(rest, rest), i1 = 1.0 / square_root(s);
  R.column[1] = i1 * rest;
  const Double4 least = 1e-24 * (s0 + s1);
  return (s0 > least) & (s > 1e-6 * s1); // nearer to a line it needs a second pass
}

// R ← R + (cof R/det R − R)/2 until the change is so small that the next one would be lost in rounding.
REND_INLINE Long4 closest_lanes(const Matrix<3>& F, Matrix<3>& R) {
  R = F;
  Long4 open{}, done{};
  for (int n = 0; n < 8; ++n) {
    const Vector c0 = cross(R.column[1], R.column[2]), c1 = cross(R.column[2], R.column[0]),
                 c2 = cross(R.column[0], R.column[1]);
    const Double4 determinant = dot(R.column[0], c0);
    if (n == 0) open = determinant > 0.0;
    const Double4 half = 0.5 / determinant;
    const Vector cofactor[3] = {c0, c1, c2};
    Double4 square{};
    for (int c = 0; c < 3; ++c) {
      Vector change = half * cofactor[c] - splat(0.5) * R.column[c];
      change = {(Double4)((Long4)change.x & open), (Double4)((Long4)change.y & open),
                (Double4)((Long4)change.z & open)};
      square += dot(change, change);
      R.column[c] = R.column[c] + change;
    }
    const Long4 arrived = open & (square < 1e-15);
    done |= arrived;
    open &= ~arrived;
    if ((open[0] | open[1] | open[2] | open[3]) == 0) break;
  }
  return done;
}

// In the plane of Gram–Schmidt's frame F is the triangle (p q; 0 r), whose rotation is known.
REND_INLINE Long4 closest_lanes(const Matrix<2>& F, Matrix<2>& R) {
  Matrix<2> frame;
  const Long4 done = gram_schmidt_lanes(F, frame);
  const Vector &a = frame.column[0], &b = frame.column[1];
  const Double4 c = dot(a, F.column[0]) + dot(b, F.column[1]), s = -dot(a, F.column[1]);
  const Double4 inverse = 1.0 / square_root(c * c + s * s), cosine = c * inverse, sine = s * inverse;
  R.column[0] = cosine * a + sine * b;
  R.column[1] = cosine * b - sine * a;
  return done;
}

template <Rotation rotation, int Columns>
REND_INLINE void turn(const Matrix<Columns>& F, const Double4& weight, Matrix<Columns>& R) {
  const Long4 done = rotation == Rotation::Qr ? gram_schmidt_lanes(F, R) : closest_lanes(F, R);
  if (all(done)) return;
  for (int lane = 0; lane < 4; ++lane)
    if (!done[lane]) turn_lane<rotation, Columns>(R, F, weight, lane);
}

} // namespace rend::lanes
