// Linear and co-rotational elasticity of one element (thesis 2.2.2, eq. 2.27, 2.33, 6.1).
//
// With F at each integration point (element.h), from x + βv where the material is damped (Rayleigh, stiffness
// part), and R the rotation of the mean of F over the volume, from x alone (linear: none),
//
//   ε = sym(RᵀF) − I,   σ = λ tr ε I + 2μ ε,   f_n = −Σ_g w R σ G_n
//
// which is −K(x − x0) of the linear element, and −R K (Rᵀx − x0) of the co-rotational one, without ever forming
// K (2.33 of the thesis has the wrong sign). A sheet has two rest axes, R is 3 × 2, and σ is that of plane
// stress, λ' = Eν/(1 − ν²). For a simplex and the polar R the force is −∇Σ w(μ|ε|² + λ/2 (tr ε)²); elements
// with one mean rotation have no energy, what is reported is that sum. A quad of a sheet turns by an R of its
// own at each point, and has that energy: with one mean rotation (as of hexahedra) a warped quad, which bends
// freely, reads its warp as compression and makes energy without end (0.2 to 7e4 J in 3 s of a free sheet of 8
// × 8). The stiffness, with g_n = R G_n and P = R Rᵀ,
//
//   K_ij = Σ_g w (λ g_i g_jᵀ + μ g_j g_iᵀ + μ (g_i·g_j) P)  + ∂f/∂R : ∂R/∂x
//
// (the latter in the exact tangent alone).
#pragma once

#include "sim/mechanics/element.h"
#include "sim/mechanics/rotation.h"

namespace rend {

enum class ElasticModel { Linear, Corotational };

// Whether R is taken at each integration point instead of from the mean.
constexpr bool turns_by_point(int dimension, int points) {
  return dimension == 2 && points > 1;
}

// How many numbers a unit carries: 3 × 3 and a weight for each integration point, of a sheet 2 × 2; of a linear
// sheet its rest axes before them.
constexpr int unit_values(ElementKind kind, ElasticModel model) {
  using enum ElementKind;
  const bool sheet = kind == Triangle || kind == Quad;
  const int points = kind == Triangle || kind == Tetrahedron ? 1 : kind == Quad ? 4 : kind == Prism ? 6 : 8;
  return points * (sheet ? 5 : 10) + (sheet && model == ElasticModel::Linear ? 6 : 0);
}

struct ElasticMaterial {
  double lambda = 0, mu = 0; // Lamé's [Pa]; of a sheet λ is that of plane stress
  double damping = 0;        // Rayleigh's β [s]
  static ElasticMaterial of(double young, double poisson, int dimension);
};

class ElementLaw : public ForceLaw {
public:
  const ElementShape& shape() const { return *shape_; }
  ElasticModel model() const { return model_; }
  Rotation rotation() const { return rotation_; }
  const ElasticMaterial& material() const { return material_; }

  // The numbers of a unit: of a linear sheet its rest axes (3 × 2, column by column), then J⁻¹ and w of each
  // point. False: the element has no volume.
  bool write_unit(const Vec3* rest, double thickness, double* unit) const;
  int first_point() const { return values() - shape_->values(); } // where the points begin

  // Means over the volume, of elasticity alone, turned to world space. Of a sheet: in its plane.
  virtual Eigen::Matrix3d stress(const double* unit, const UnitState& s) const = 0; // σ [Pa]
  virtual Eigen::Matrix3d strain(const double* unit, const UnitState& s) const = 0; // ε

  bool acts(const double* unit, const std::uint32_t*) const override { return unit[values() - 1] != 0; }

protected:
  ElementLaw(const ElementShape& shape, ElasticModel model, Rotation rotation, const ElasticMaterial& material);

private:
  const ElementShape* shape_;
  ElasticModel model_;
  Rotation rotation_;
  ElasticMaterial material_;
};

std::shared_ptr<const ElementLaw> element_law(ElementKind kind, ElasticModel model, Rotation rotation,
                                              const ElasticMaterial& material);

// λmax of K [N/m] of an element whose points (J⁻¹ and w) are given; with masses, of M^(−1/2) K M^(−1/2) [1/s²],
// corners without mass held.
double largest_stiffness(const ElementShape& shape, const double* points, const ElasticMaterial& material,
                         const double* mass);

} // namespace rend
