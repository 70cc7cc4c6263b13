// Stresses of four elements at a time, in the frame of the element or of the body, the moment that they have on
// that frame (mechanics/rotation.h), and the small tensors of enhanced modes (mechanics/enhanced_modes.h).
#pragma once

#include "sim/rows/element_lanes.h"
#include "sim/rows/rotation_lanes.h"

namespace rend::lanes {

// w R σ with σ of the strain sym(RᵀF) − I.
template <int Dim>
REND_INLINE Matrix<Dim> rotated_stress(const Matrix<Dim>& R, const Matrix<Dim>& F, const Double4& weight,
                                       double lambda, double mu) {
  Double4 U[Dim][Dim]; // RᵀF
  for (int r = 0; r < Dim; ++r)
    for (int c = 0; c < Dim; ++c) U[r][c] = dot(R.column[r], F.column[c]);
  Double4 trace = U[0][0];
  for (int r = 1; r < Dim; ++r) trace += U[r][r];
  trace = (lambda * weight) * (trace - static_cast<double>(Dim));
  const Double4 once = mu * weight, twice = 2.0 * once;
  Matrix<Dim> P;
  for (int c = 0; c < Dim; ++c) {
    P.column[c] = (twice * (U[c][c] - 1.0) + trace) * R.column[c];
    for (int r = 0; r < Dim; ++r)
      if (r != c) P.column[c] = P.column[c] + (once * (U[r][c] + U[c][r])) * R.column[r];
  }
  return P;
}

// The same with R = I: w σ.
REND_INLINE Matrix<3> stress(const Matrix<3>& F, const Double4& weight, double lambda, double mu) {
  const Vector &f0 = F.column[0], &f1 = F.column[1], &f2 = F.column[2];
  const Double4 once = mu * weight, twice = 2.0 * once;
  const Double4 trace = (lambda * weight) * (f0.x + f1.y + f2.z - 3.0);
  const Double4 xy = once * (f1.x + f0.y), xz = once * (f2.x + f0.z), yz = once * (f2.y + f1.z);
  return {{{twice * (f0.x - 1.0) + trace, xy, xz},
           {xy, twice * (f1.y - 1.0) + trace, yz},
           {xz, yz, twice * (f2.z - 1.0) + trace}}};
}

// If R is the polar factor of F itself, RᵀF is symmetric, and w R σ = w (2μ (F − R) + λ tr(RᵀF − I) R).
template <int Dim>
REND_INLINE Matrix<Dim> stretched_stress(const Matrix<Dim>& R, const Matrix<Dim>& F, const Double4& weight,
                                         double lambda, double mu) {
  Double4 trace = dot(R.column[0], F.column[0]);
  for (int c = 1; c < Dim; ++c) trace += dot(R.column[c], F.column[c]);
  const Double4 twice = (2.0 * mu) * weight;
  const Double4 turned = (lambda * weight) * (trace - static_cast<double>(Dim)) - twice;
  Matrix<Dim> P;
  for (int c = 0; c < Dim; ++c) P.column[c] = twice * F.column[c] + turned * R.column[c];
  return P;
}

// w σ of the strain sym(U) − I with U = RᵀF, in the rotated frame: its diagonal, and off[n] in the plane
// normal to axis n. `skew`: twice the skew part of U, as a vector. `triangular`: the entries of U below the
// diagonal are 0.
struct TurnedStress {
  Double4 on[3], off[3], skew[3];
};

template <bool triangular>
REND_INLINE TurnedStress turned_stress(const Matrix<3>& R, const Matrix<3>& F, const Double4& weight,
                                       double lambda, double mu) {
  TurnedStress s;
  for (int c = 0; c < 3; ++c) s.on[c] = dot(R.column[c], F.column[c]);
  const Double4 trace = (lambda * weight) * (s.on[0] + s.on[1] + s.on[2] - 3.0);
  const Double4 once = mu * weight, twice = 2.0 * once;
  for (int c = 0; c < 3; ++c) s.on[c] = twice * (s.on[c] - 1.0) + trace;
  for (int n = 0; n < 3; ++n) {
    const int r = (n + 1) % 3, c = (n + 2) % 3;
    if constexpr (triangular) {
      const Double4 above = r < c ? dot(R.column[r], F.column[c]) : dot(R.column[c], F.column[r]);
      s.off[n] = once * above;
      s.skew[n] = r < c ? -above : above;
    } else {
      const Double4 rc = dot(R.column[r], F.column[c]), cr = dot(R.column[c], F.column[r]);
      s.off[n] = once * (rc + cr);
      s.skew[n] = cr - rc;
    }
  }
  return s;
}

// −t of one point: the moment of σUᵀ is −(tr σ I − σ) ω, where [ω]× is the skew part of U, since σ commutes
// with the strain.
REND_INLINE Vector moment_against(const TurnedStress& s) {
  const Double4 x = s.on[1] + s.on[2], y = s.on[0] + s.on[2], z = s.on[0] + s.on[1];
  const Double4 half = splat(0.5);
  return half * Vector{x * s.skew[0] - s.off[2] * s.skew[1] - s.off[1] * s.skew[2],
                       y * s.skew[1] - s.off[2] * s.skew[0] - s.off[0] * s.skew[2],
                       z * s.skew[2] - s.off[1] * s.skew[0] - s.off[0] * s.skew[1]};
}

// The same on the frame of a point of a sheet, by QR: what the stress loses in its entry (1, 0), times w.
REND_INLINE Double4 sheet_moment(const Matrix<2>& R, const Matrix<2>& F, const Double4& weight, double lambda,
                                 double mu) {
  const Vector &r0 = R.column[0], &r1 = R.column[1];
  const Double4 U00 = dot(r0, F.column[0]), U11 = dot(r1, F.column[1]);
  const Double4 skew = dot(r1, F.column[0]) - dot(r0, F.column[1]);
  return ((lambda + mu) * weight) * (2.0 - U00 - U11) * skew / at_least(U00, least_qr);
}

// Turns so many vectors by R.
REND_INLINE void turn_all(const Matrix<3>& R, Vector* v, int count) {
  for (int n = 0; n < count; ++n) v[n] = v[n].x * R.column[0] + v[n].y * R.column[1] + v[n].z * R.column[2];
}

// sum ± of.
REND_INLINE void add_signed(TurnedStress& sum, const TurnedStress& of, bool plus) {
  for (int n = 0; n < 3; ++n) {
    sum.on[n] = plus ? sum.on[n] + of.on[n] : sum.on[n] - of.on[n];
    sum.off[n] = plus ? sum.off[n] + of.off[n] : sum.off[n] - of.off[n];
  }
}

// r becomes α = −D⁻¹ r; `inverse`: its upper triangle, row by row.
REND_INLINE void amplify(const double* inverse, Vector* r) {
  Double4 from[9], to[9] = {};
  for (int a = 0; a < 3; ++a) from[3 * a] = r[a].x, from[3 * a + 1] = r[a].y, from[3 * a + 2] = r[a].z;
  for (int i = 0; i < 9; ++i) {
    for (int j = i; j < 9; ++j, inverse += 4) {
      const Double4 d = load_four(inverse);
      to[i] -= d * from[j];
      if (j != i) to[j] -= d * from[i];
    }
  }
  for (int a = 0; a < 3; ++a) r[a] = {to[3 * a], to[3 * a + 1], to[3 * a + 2]};
}

// axial(A B) of two symmetric tensors.
REND_INLINE Vector axial_product(const TurnedStress& A, const TurnedStress& B) {
  const auto entry = [](const TurnedStress& S, int i, int j) -> const Double4& {
    return i == j ? S.on[i] : S.off[3 - i - j];
  };
  Double4 v[3] = {};
  for (int k = 0; k < 3; ++k) {
    const int r = (k + 1) % 3, c = (k + 2) % 3;
    for (int j = 0; j < 3; ++j) v[k] += entry(A, c, j) * entry(B, j, r) - entry(A, r, j) * entry(B, j, c);
  }
  return {v[0], v[1], v[2]};
}

} // namespace rend::lanes
