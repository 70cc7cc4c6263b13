// The rotation R of a deformation gradient F, for co-rotational elements.
//
// Polar: the R with det R = +1 that is closest to F in the Frobenius norm, for every F (Kabsch 1976; inverted
// elements: Irving et al. 2004). Where det F > 0 it is the limit of R ← (R + R⁻ᵀ)/2 from F (Higham 1986), which
// needs no square root and no initial guess; otherwise it is computed from the singular value decomposition,
// with the sign of the smallest singular value flipped. It does not depend on the choice of axes. QR:
// Gram–Schmidt of the columns of F (thesis 2.3.3; Nesme et al. 2005): the first edge keeps its direction, the
// third axis is what makes it right-handed.
//
// For a sheet the third column of F is 0 and that of R is normal to the sheet; the first two columns of R are
// the 3 × 2 rotation.
//
// The derivative of R: dR = R [ω]×, where ω solves a linear system that F alone decides. With U = RᵀF and
// A = Rᵀ dF,
//
//   H(U) ω = a(A)     polar   H = tr U I − U,  a = (A21 − A12, A02 − A20, A10 − A01)
//                     QR      rows (U11, −U01, 0), (0, −U00, 0), (0, 0, U00),  a = (A21, A20, A10)
//
// A potential U(F, R) whose R turns by ω changes by −t·ω. The moment t then belongs to F: t·ω = Z : A with
// Z = aᵀ(z), Hᵀ z = t, for which polar gives Z = [z]×. Near a flip of R (H singular: an element is inverted, or
// flat) z grows without bound, and R jumps; H⁻¹ is bounded there, so that forces stay finite.
#pragma once

#include "sim/base/record.h"

namespace rend {

enum class Rotation { Polar, Qr };

Eigen::Matrix3d closest_rotation(const Eigen::Matrix3d& F);       // finite and a rotation for every finite F
Eigen::Matrix3d closest_sheet_rotation(const Eigen::Matrix3d& F); // the same for a third column of 0
Eigen::Matrix3d gram_schmidt(const Eigen::Matrix3d& F, int dimension); // the same; for a sheet `dimension` is 2

// Bounds of H⁻¹ in the moment: the least det H (8 at rest) and, for QR, the least U00 and U11 (1 at rest).
constexpr double least_polar = 1e-2, least_qr = 5e-2;

// [v]×
inline Eigen::Matrix3d cross_matrix(const Vec3& v) {
  Eigen::Matrix3d M;
  M << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return M;
}

// [e_axis]× M
inline Eigen::Matrix3d turned_about(int axis, const Eigen::Matrix3d& M) {
  Eigen::Matrix3d turned;
  turned.row(axis).setZero();
  turned.row((axis + 1) % 3) = -M.row((axis + 2) % 3);
  turned.row((axis + 2) % 3) = M.row((axis + 1) % 3);
  return turned;
}

// a with [ω]× : M = a·ω for every ω
inline Vec3 axial(const Eigen::Matrix3d& M) {
  return {M(2, 1) - M(1, 2), M(0, 2) - M(2, 0), M(1, 0) - M(0, 1)};
}

// The derivative of R by F. ω is taken as 0 where it does not exist (F is rank-deficient, or R is about to
// flip).
class RotationDerivative {
public:
  RotationDerivative(Rotation rotation, const Eigen::Matrix3d& R, const Eigen::Matrix3d& F);
  Eigen::Matrix3d of(const Vec3& b) const; // L(b): dF = a bᵀ turns R by ω = L(b) Rᵀa

  struct Moment {
    Vec3 z;
    Eigen::Matrix3d Z;
  };
  Moment moment(const Vec3& t) const;
  // The change of Z if t changes by dt and U by dU; the bound of H⁻¹ is taken as constant.
  Eigen::Matrix3d moment_change(const Vec3& z, const Vec3& dt, const Eigen::Matrix3d& dU) const;

private:
  Eigen::Matrix3d system(const Eigen::Matrix3d& U) const; // H
  Eigen::Matrix3d back(const Vec3& z) const;              // aᵀ

  Rotation rotation_;
  bool turns_;
  Eigen::Matrix3d inverse_, bounded_; // H⁻¹; bounded for the moment
};

} // namespace rend
