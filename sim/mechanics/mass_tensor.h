// Mass-tensors: the stiffness matrix of linear elasticity stored on vertices, edges and diagonals (Cotin et al.
// 2000; thesis 2.3.4, 5.3, fig. 5.24).
//
//   f_i = −Σ_j K_ij u_j,   u = x − x0 (and βv),   K_ij = Σ_g w (λ G_i G_jᵀ + μ G_j G_iᵀ + μ (G_i·G_j) P)
//
// (P = I for a solid, for a sheet the projection onto the plane of the element.) 2.31 and 2.32 of the thesis
// lack the sign and the order of the outer products. Since K_ji = K_ijᵀ one tensor serves both ends of a pair:
// a tetrahedron has 4 diagonal tensors and 6 pairs, a hexahedron 8 and 28. Elementary tensors are stored on
//
//   diagonal          VertexOfVolume <1,2>   (sheet: VertexOfFace <1>)
//   edges             EdgeOfVolume <0,2>     (sheet: EdgeOfFace <0>)
//   face diagonals    FaceOfVolume <0,1>, two of a quad
//   volume diagonals  Volume <0,1,2>, four of a hexahedron
//
// and depend on the whole element, which is their support. Cumulated rows sum those between the same particles,
// across α3 (in a sheet α2).
#pragma once

#include "sim/mechanics/element_law.h"

namespace rend {

struct MassTensorRequest {
  ElasticMaterial material;
  double thickness; // [m], of a sheet
  Place place;      // for error messages
};

// A unit with one particle: K_ii row by row, and the largest eigenvalue of the whole element's K. With two:
// K_ij row by row.
class MassTensorLaw : public ForceLaw {
public:
  double damping() const { return request_.material.damping; } // β [s]
  const MassTensorRequest& request() const { return request_; }

protected:
  MassTensorLaw(std::string name, int particles, int values, MassTensorRequest request)
      : ForceLaw(std::move(name), particles, values), request_(std::move(request)) {}

private:
  MassTensorRequest request_;
};

std::shared_ptr<const MassTensorLaw> vertex_tensor_law(const MassTensorRequest& request);
std::shared_ptr<const MassTensorLaw> pair_tensor_law(const MassTensorRequest& request);

// Adds the embeddings. UserError: an element without volume. Empty: no element of a supported shape. `awaited`:
// as of make_elasticity().
std::vector<std::unique_ptr<Interaction>> make_mass_tensors(EmbeddedMap& map, const MassTensorRequest& request,
                                                            std::vector<AwaitedInteraction>* awaited = nullptr);

// K_ij [N/m] of the element with corners i and j, at rest.
struct ElementTensors {
  ElementKind kind;
  int corners;
  double largest; // eigenvalue of the element's K [N/m]
  std::array<std::array<Eigen::Matrix3d, most_particles>, most_particles> K;
};
// UserError: the element has no volume.
ElementTensors element_tensors(const ElementShape& shape, const std::vector<Vec3>& rest,
                               const MassTensorRequest& request);

} // namespace rend
