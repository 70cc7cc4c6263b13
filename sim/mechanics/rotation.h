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
// The derivative of R: dR = R [ω]×, for dF = a bᵀ with ω = L(b) Rᵀa,
//   polar   (tr S I − S) ω = b × Rᵀa with S = RᵀF
//   QR      from the entries of RᵀdF below the diagonal, with U = RᵀF
#pragma once

#include "sim/base/record.h"

namespace rend {

enum class Rotation { Polar, Qr };

Eigen::Matrix3d closest_rotation(const Eigen::Matrix3d& F);       // finite and a rotation for every finite F
Eigen::Matrix3d closest_sheet_rotation(const Eigen::Matrix3d& F); // the same for a third column of 0
Eigen::Matrix3d gram_schmidt(const Eigen::Matrix3d& F, int dimension); // the same; for a sheet `dimension` is 2

// The derivative of R by F. It is taken as 0 where it does not exist (F is rank-deficient, or R is about to
// flip).
class RotationDerivative {
public:
  RotationDerivative(Rotation rotation, const Eigen::Matrix3d& R, const Eigen::Matrix3d& F);
  Eigen::Matrix3d of(const Vec3& b) const; // L(b)

private:
  Rotation rotation_;
  bool turns_;
  Eigen::Matrix3d matrix_; // polar: (tr S I − S)⁻¹; QR: U
};

} // namespace rend
