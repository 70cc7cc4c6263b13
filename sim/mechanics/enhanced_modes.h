// Enhanced modes of quads and hexahedra: what lets them bend (Wilson et al. 1973; Taylor, Beresford and Wilson
// 1976; as enhanced strains, Simo and Rifai 1990).
//
// Multilinear shape functions cannot bend: in place of curvature they shear. The modes M_a = 1 − ξ_a² of each
// reference axis a are added inside the element, with amplitudes α_a that no other element knows,
//
//   ε = sym(RᵀF) − I + sym Σ_a α_a W_aᵀ/w,   W_a = ± H_a,   H_a = (V / points) J₀⁻ᵀ e_a
//
// in the rotated frame. J₀ is J in the middle, and det J is taken as constant (Taylor), so that the W_a of all
// points sum to 0: a uniform strain excites no mode, and the patch test holds for distorted elements too. The
// sign is that of ξ_a at the point. The energy is least for the amplitudes
//
//   α = −D⁻¹ r,   r_a = Σ_g σ(sym(RᵀF) − I) W_a,   D = Σ_g ∂²/∂α²
//
// where D depends on the shape at rest and on the material alone: its inverse is kept (45 numbers for a
// hexahedron), rather than a stiffness matrix (300), since K ≤ that of the plain element follows (and with it
// every bound of the step), and integration points still have their stress.
//
// Under large compression such elements may fold into an hourglass (Wriggers and Reese 1996): plain ones are
// the default.
#pragma once

#include "sim/mechanics/element.h"

#include <array>

namespace rend {

struct ElasticMaterial;

constexpr bool can_be_enhanced(ElementKind kind) {
  return kind == ElementKind::Quad || kind == ElementKind::Hexahedron;
}

// The number of values: H_a (dimension of them, as rows) and the upper triangle of D⁻¹, row by row, with the
// amplitudes in the order α_0x α_0y α_0z α_1x ...
constexpr int enhanced_values(int dimension) {
  const int modes = dimension * dimension;
  return dimension * dimension + modes * (modes + 1) / 2;
}

// `frame`: rest axes as columns; `points`: J⁻¹ and w of each point, as write_element() wrote them.
void write_enhanced_modes(const ElementShape& shape, const Vec3* rest, const Eigen::Matrix3d& frame,
                          const ElasticMaterial& material, const double* points, double* values);

template <int Dim, int Points> struct EnhancedModes {
  static constexpr int modes = Dim * Dim;
  using Amplitudes = Eigen::Matrix<double, modes, 1>;
  using Stresses = std::array<Eigen::Matrix3d, static_cast<std::size_t>(Points)>;

  Eigen::Matrix<double, 3, Dim> H = Eigen::Matrix<double, 3, Dim>::Zero(); // [m², of a sheet m; third row 0]
  Eigen::Matrix<double, modes, modes> inverse;                             // D⁻¹ [m/N]

  explicit EnhancedModes(const double* values) {
    for (int a = 0; a < Dim; ++a)
      for (int c = 0; c < Dim; ++c) H(c, a) = *values++;
    for (int r = 0; r < modes; ++r)
      for (int c = r; c < modes; ++c) inverse(r, c) = inverse(c, r) = *values++;
  }

  Vec3 at(std::size_t g, int a) const { return (g >> a & 1 ? 1.0 : -1.0) * H.col(a); } // W_a

  Amplitudes of(const Stresses& stress) const { // α
    Amplitudes r = Amplitudes::Zero();
    for (std::size_t g = 0; g < stress.size(); ++g)
      for (int a = 0; a < Dim; ++a)
        r.template segment<Dim>(Dim * a) += (stress[g] * at(g, a)).template head<Dim>();
    return -(inverse * r);
  }

  Eigen::Matrix3d strain(std::size_t g, double weight, const Amplitudes& alpha) const {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (int a = 0; a < Dim; ++a)
      sum.template topRows<Dim>() += alpha.template segment<Dim>(Dim * a) * at(g, a).transpose();
    return 0.5 / weight * (sum + sum.transpose());
  }
};

} // namespace rend
