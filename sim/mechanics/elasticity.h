// <elasticity>: a continuum on the elements of a body (thesis 2.2.2, 5.2.4, eq. 2.27 to 2.33).
//
// One interaction for each kind of element that the body has; owner the element itself (FaceOfVolume of a
// sheet, Volume of a solid), support the same, so that a separation leaves its numbers alone. A mass-tensor
// body has interactions on its vertices, edges and diagonals instead (mass_tensor.h).
//
// Adding a model: a word in the list of `model`, and its interactions in make_elasticity().
#pragma once

#include "sim/mechanics/element_law.h"

namespace rend {

struct MassTensorRequest;

const ElementType& elasticity_type();

struct ElasticityRequest {
  const Node& node;                // <elasticity>
  std::vector<std::string>& notes; // what the preset's author should know
};

// Adds the embeddings to the map. UserError: an element without volume, by its name and place; a sheet without
// thickness, or a solid with one; no element that fits.
std::vector<std::unique_ptr<Interaction>> make_elasticity(EmbeddedMap& map, const ElasticityRequest& request);

// The linear elements that mass-tensors are made of, to be asked for stress and forces. They are no embedding:
// the numbers of a unit are made when they are asked for, and last until the next are.
std::vector<std::unique_ptr<Interaction>> linear_elements(const EmbeddedMap& map,
                                                          const MassTensorRequest& request);

// E and ν of the request, β from its damping-stiffness.
ElasticMaterial elastic_material(const Node& node, int dimension);

[[noreturn]] void refuse_flat_element(const Place& place, const ElementShape& shape,
                                      const std::vector<Vec3>& rest);

} // namespace rend
