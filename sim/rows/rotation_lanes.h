// The rotations of mechanics/rotation.h, for four elements at once.
//
// Lanes in which the fast method fails (flat or inverted elements) are computed by the reference, one by one;
// padding rows, whose weight is 0, are skipped. The result of a lane never depends on the others: lanes that
// have converged are not changed any more.
#pragma once

#include "sim/mechanics/rotation.h"
#include "sim/rows/lanes.h"

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

// Computes one lane by the reference; 0 for padding.
template <Rotation rotation, int Columns>
[[gnu::noinline]] void rotation_of_lane(Matrix<Columns>& R, const Matrix<Columns>& F, const Double4& weight,
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
REND_INLINE bool any(const Long4& mask) {
  return (mask[0] | mask[1] | mask[2] | mask[3]) != 0;
}

REND_INLINE Double4 at_least(const Double4& value, double bound) {
  return value > bound ? value : splat(bound);
}

// Returns the lanes that succeeded.
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
  return (s0 > least) & (s > 1e-6 * s1); // closer to collinear, a second pass is needed
}

REND_INLINE Long4 gram_schmidt_lanes(const Matrix<2>& F, Matrix<2>& R) {
  const Vector &f0 = F.column[0], &f1 = F.column[1];
  const Double4 s0 = dot(f0, f0), s1 = dot(f1, f1), i0 = 1.0 / square_root(s0);
  R.column[0] = i0 * f0;
  const Vector rest = f1 - dot(R.column[0], f1) * R.column[0];
  const Double4 s = dot(rest, rest), i1 = 1.0 / square_root(s);
  R.column[1] = i1 * rest;
  const Double4 least = 1e-24 * (s0 + s1);
  return (s0 > least) & (s > 1e-6 * s1); // closer to collinear, a second pass is needed
}

// The largest root of (s² − I)² = 4 II + 8 J s, starting from √(3 I) ≥ s: as all roots are real, Halley's
// iteration decreases monotonically to it, tripling the number of digits each time. `open`: the lanes to
// compute; converged ones are removed.
REND_INLINE Double4 sum_of_singular_values(const Double4& first, const Double4& second, const Double4& J,
                                           Long4& open) {
  constexpr double near = 3e-6; // relative step: the remaining error is of the order of its cube
  Double4 s = square_root(3.0 * first);
  for (int n = 0; n < 8; ++n) {
    const Double4 t = s * s - first, value = t * t - 4.0 * second - 8.0 * J * s;
    const Double4 slope = 4.0 * s * t - 8.0 * J, bend = 4.0 * t + 8.0 * s * s;
    const Double4 step = value * slope / (slope * slope - 0.5 * value * bend);
    s -= (Double4)((Long4)step & open);
    open &= ~((step < near * s) & (step > -near * s));
    if (!any(open)) break;
  }
  return s;
}

// The closest rotation from the invariants of C = FᵀF. With singular values λ of F (the smallest one negative
// if F is inverted) and I = tr C, II = |cof F|², J = det F, the sum s = Σ λ is a root of (s² − I)² = 4 II + 8 J
// s, and R is its derivative by F (Hoger and Carlson 1984 for the invariants; Lin, Chitalu and Komura 2022):
//
//   R = ( (s² + I) F − 2 F C + 2 s cof F ) / ( s (s² − I) − 2 J )
//
// The denominator is 2 (λ1 + λ2)(λ2 + λ3)(λ3 + λ1): where it is small relative to s³, F is nearly singular and
// digits are lost.
REND_INLINE Long4 closest_lanes(const Matrix<3>& F, Matrix<3>& R) {
  constexpr double least = 0.02; // relative to s³: above it, 12 digits are correct
  const Vector &f0 = F.column[0], &f1 = F.column[1], &f2 = F.column[2];
  const Vector g0 = cross(f1, f2), g1 = cross(f2, f0), g2 = cross(f0, f1);
  const Double4 c00 = dot(f0, f0), c11 = dot(f1, f1), c22 = dot(f2, f2);
  const Double4 first = c00 + c11 + c22, second = dot(g0, g0) + dot(g1, g1) + dot(g2, g2), J = dot(f0, g0);
  const Long4 sized = first > 0.0; // neither padding nor NaN
  Long4 open = sized;
  const Double4 s = sum_of_singular_values(first, second, J, open), square = s * s;
  const Double4 below = s * (square - first) - 2.0 * J;
  const Double4 inverse = 1.0 / below, twice = 2.0 * inverse, own = inverse * (square + first),
                other = twice * s;
  const Double4 c01 = twice * dot(f0, f1), c02 = twice * dot(f0, f2), c12 = twice * dot(f1, f2);
  R.column[0] = (own - twice * c00) * f0 - c01 * f1 - c02 * f2 + other * g0;
  R.column[1] = (own - twice * c11) * f1 - c01 * f0 - c12 * f2 + other * g1;
  R.column[2] = (own - twice * c22) * f2 - c02 * f0 - c12 * f1 + other * g2;
  return sized & ~open & (below > least * square * s);
}

// In the plane of Gram–Schmidt's frame F is the triangular matrix (p q; 0 r), whose polar rotation is known in
// closed form.
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
REND_INLINE void rotations_of(const Matrix<Columns>& F, const Double4& weight, Matrix<Columns>& R) {
  const Long4 done = rotation == Rotation::Qr ? gram_schmidt_lanes(F, R) : closest_lanes(F, R);
  if (all(done)) return;
  for (int lane = 0; lane < 4; ++lane)
    if (!done[lane]) rotation_of_lane<rotation, Columns>(R, F, weight, lane);
}

// The moment's part of the stress, Z of mechanics/rotation.h: z of the moment t on a frame R of the mean
// gradient F.
template <Rotation rotation>
REND_INLINE Vector moment_of(const Matrix<3>& R, const Matrix<3>& F, const Vector& t) {
  const Vector &r0 = R.column[0], &r1 = R.column[1], &r2 = R.column[2];
  const Vector &f0 = F.column[0], &f1 = F.column[1], &f2 = F.column[2];
  if constexpr (rotation == Rotation::Qr) {
    const Double4 U00 = at_least(dot(r0, f0), least_qr), U11 = at_least(dot(r1, f1), least_qr);
    const Double4 x = t.x / U11;
    return {x, -(t.y + dot(r0, f1) * x) / U00, t.z / U00};
  } else {
    const Double4 u0 = dot(r0, f0), u1 = dot(r1, f1), u2 = dot(r2, f2);
    const Double4 a = u1 + u2, b = u0 + u2, c = u0 + u1; // H = (a −h −g; −h b −f; −g −f c)
    const Double4 f = 0.5 * (dot(r1, f2) + dot(r2, f1)), g = 0.5 * (dot(r0, f2) + dot(r2, f0)),
                  h = 0.5 * (dot(r0, f1) + dot(r1, f0));
    const Vector x{b * c - f * f, f * g + h * c, h * f + b * g}; // adj H, row by row
    const Double4 yy = a * c - g * g, yz = a * f + g * h, zz = a * b - h * h;
    const Double4 inverse = 1.0 / at_least(a * x.x - h * x.y - g * x.z, least_polar);
    return inverse * Vector{dot(x, t), x.y * t.x + yy * t.y + yz * t.z, x.z * t.x + yz * t.y + zz * t.z};
  }
}

} // namespace rend::lanes
