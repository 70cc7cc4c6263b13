// The rotation in a deformation gradient F, by which a co-rotational element turns.
//
// Polar: the R with det R = +1 that is closest to F in the sum of squares, whatever F is (Kabsch 1976; inverted
// elements: Irving et al. 2004). Where det F > 0 it is the limit of R ← (R + R⁻ᵀ)/2 from F (Higham 1986), which
// needs no root and no start; else it comes from singular values, the sign of the smallest turned. It does not
// depend on the axes in which F is written.
// QR: Gram–Schmidt of the columns of F (thesis 2.3.3; Nesme et al. 2005): the first edge keeps its direction,
// the third axis is what makes it right-handed.
//
// Of a sheet F has a third column of 0 and R a third column normal to the sheet; the first two are the 3 × 2
// matrix with orthonormal columns that is meant.
//
// When F moves, R turns: dR = R [ω]×, for dF = a bᵀ with ω = L(b) Rᵀa,
//   polar   (tr S I − S) ω = b × Rᵀa with S = RᵀF
//   QR      from the entries of RᵀdF below the diagonal, with U = RᵀF
#pragma once

#include "sim/base/record.h"

namespace rend {

enum class Rotation { Polar, Qr };

Eigen::Matrix3d closest_rotation(const Eigen::Matrix3d& F);       // finite and a rotation for every finite F
Eigen::Matrix3d closest_sheet_rotation(const Eigen::Matrix3d& F); // the same where the third column is 0
Eigen::Matrix3d gram_schmidt(const Eigen::Matrix3d& F, int dimension); // the same; of a sheet `dimension` is 2

// How R turns with F. Where that has no limit (F has lost a direction, or is about to flip) it does not turn.
class Spin {
public:
  Spin(Rotation rotation, const Eigen::Matrix3d& R, const Eigen::Matrix3d& F);
  Eigen::Matrix3d of(const Vec3& b) const; // L(b)

private:
  Rotation rotation_;
  bool turns_;
  Eigen::Matrix3d matrix_; // polar: (tr S I − S)⁻¹; QR: U
};

} // namespace rend
