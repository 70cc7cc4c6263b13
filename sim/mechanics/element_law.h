// Linear and co-rotational elasticity of one element (thesis 2.2.2, eq. 2.27, 2.33, 6.1).
//
// With F the deformation gradient at each integration point (element.h), of x + βv if the material is damped
// (Rayleigh, stiffness part), and R the rotation of the volume average of F, of x alone (linear: R = I),
//
//   ε = sym(RᵀF) − I,   σ = λ tr ε I + 2μ ε,   f_n = −Σ_g w R (σ − Z) G_n
//
// which for the linear element is −K(x − x0), and for the co-rotational one −R K (Rᵀx − x0), without assembling
// K (2.33 of the thesis has the wrong sign), and with what the thesis leaves out: R itself depends on x. The
// force is −∇U, U = Σ w (μ|ε|² + λ/2 (tr ε)²), so that it keeps energy and angular momentum. If R alone turns
// by ω, U changes by −t·ω,
//
//   t = Σ_g w axial(σ Uᵀ) of U = RᵀF,   Z = aᵀ(H⁻ᵀ t) / Σ w    (rotation.h)
//
// (Chao, Pinkall, Sanan and Schröder 2010 take the R that minimises U, for which t = 0.) Without Z a hexahedron
// that spins for 10⁶ steps gains energy, up to 100 % with the QR of the thesis. Z = 0 where R is the polar
// rotation of a single F: RᵀF is then symmetric and σ commutes with it. Damping is that of the frame as it
// stands, −β R K Rᵀv: it dissipates, but where the element is strained it also brakes its rotation, by a
// share of the order of the strain.
//
// `Formulation::Enhanced` adds modes to ε of quads and hexahedra (enhanced_modes.h); σ then does not commute
// with RᵀF, and Z is there for every kind of frame.
//
// A sheet has two rest axes, R is 3 × 2, and σ is that of plane stress, λ' = Eν/(1 − ν²). A quad of a sheet has
// its own R at each point: with one average rotation (as for hexahedra) a warped quad, which bends freely,
// would have its warp count as compression. The stiffness, with g_n = R G_n and P = R Rᵀ,
//
//   K_ij = Σ_g w (λ g_i g_jᵀ + μ g_j g_iᵀ + μ (g_i·g_j) P)  + ∂f/∂R : ∂R/∂x + ∂f/∂Z : ∂Z/∂x
//
// (the last terms in the exact tangent only). Where Z = 0 they are known in closed form: with the stretches s_a
// along the axes q_a of RᵀF and the stresses σ_a there, for each pair of axes a, b and w_n = R (c × G_n) of the
// third axis c,
//
//   Σ_g w ½ (σ_a + σ_b)/(s_a + s_b) w_i w_jᵀ,    in a sheet also  Σ_g w Σ_a σ_a/s_a (q_a·G_i) (q_a·G_j) n nᵀ
//
// the modes of twist of an isotropic energy (Smith, de Goes and Kim, "Analytic eigensystems for isotropic
// distortion energies", 2019). As changes of F they are orthogonal to all others, so that without those whose
// factor is negative the tangent by F is the exact one projected to the nearest semi-definite:
// Tangent::Projected. A membrane under tension has no other stiffness against motion across it.
#pragma once

#include "sim/mechanics/enhanced_modes.h"
#include "sim/mechanics/rotation.h"

namespace rend {

enum class ElasticModel { Linear, Corotational };
enum class Formulation { Plain, Enhanced }; // enhanced: quads and hexahedra with modes (enhanced_modes.h)

struct ElementSettings {
  ElasticModel model = ElasticModel::Corotational;
  Rotation rotation = Rotation::Polar;
  Formulation formulation = Formulation::Plain;
};

// Whether each integration point has its own R instead of that of the average F.
constexpr bool rotates_per_point(int dimension, int points) {
  return dimension == 2 && points > 1;
}

// The number of values of a unit: 3 × 3 and a weight for each integration point, for a sheet 2 × 2 and a
// weight; a linear sheet has its rest axes before them, an enhanced element its modes behind them.
constexpr int unit_values(ElementKind kind, ElasticModel model, Formulation formulation = Formulation::Plain) {
  using enum ElementKind;
  const bool sheet = kind == Triangle || kind == Quad;
  const int points = kind == Triangle || kind == Tetrahedron ? 1
                     : kind == Hexahedron                    ? 8
                     : kind == Prism                         ? 6
                                                             : 4;
  const int modes =
      formulation == Formulation::Enhanced && can_be_enhanced(kind) ? enhanced_values(sheet ? 2 : 3) : 0;
  return points * (sheet ? 5 : 10) + (sheet && model == ElasticModel::Linear ? 6 : 0) + modes;
}

struct ElasticMaterial {
  double lambda = 0, mu = 0; // Lamé's [Pa]; for a sheet λ is that of plane stress
  double damping = 0;        // Rayleigh's β [s]
  static ElasticMaterial of(double young, double poisson, int dimension);
};

class ElementLaw : public ForceLaw {
public:
  const ElementShape& shape() const { return *shape_; }
  ElasticModel model() const { return model_; }
  Rotation rotation() const { return rotation_; }
  Formulation formulation() const { return formulation_; }
  const ElasticMaterial& material() const { return material_; }

  // Writes the values of a unit: for a linear sheet its rest axes (3 × 2, column by column), then J⁻¹ and w of
  // each point, for an enhanced element its modes. False: the element has no volume.
  bool write_unit(const Vec3* rest, double thickness, double* unit) const;
  // indices of the values of the first integration point and of the modes
  int first_point() const { return model() == ElasticModel::Linear && shape_->dimension == 2 ? 6 : 0; }
  int first_mode() const { return first_point() + shape_->values(); }

  // Volume averages, of elasticity without damping, in world axes. For a sheet: in its plane.
  virtual Eigen::Matrix3d stress(const double* unit, const UnitState& s) const = 0; // σ [Pa]
  virtual Eigen::Matrix3d strain(const double* unit, const UnitState& s) const = 0; // ε

  bool acts(const double* unit, const std::uint32_t*) const override { return unit[first_mode() - 1] != 0; }

protected:
  ElementLaw(const ElementShape& shape, const ElementSettings& settings, const ElasticMaterial& material);

private:
  const ElementShape* shape_;
  ElasticModel model_;
  Rotation rotation_;
  ElasticMaterial material_;
  Formulation formulation_;
};

// Kinds without modes are plain.
std::shared_ptr<const ElementLaw> element_law(ElementKind kind, ElasticModel model, Rotation rotation,
                                              const ElasticMaterial& material,
                                              Formulation formulation = Formulation::Plain);

// λmax of K [N/m] of an element whose point values (J⁻¹ and w) are given; with masses, of M^(−1/2) K M^(−1/2)
// [1/s²], with corners without mass held fixed.
double largest_stiffness(const ElementShape& shape, const double* points, const ElasticMaterial& material,
                         const double* mass);

} // namespace rend
