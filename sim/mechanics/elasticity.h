// <elasticity>: a continuum on the elements of a body (thesis 2.2.2, 5.2.4, eq. 2.27 to 2.33).
//
// One interaction for each kind of element that the body has, or comes to have; owner the element itself
// (FaceOfVolume of a sheet, Volume of a solid), which is also the support, so that a separation does not change
// its values. With mass-tensors the interactions are on the vertices, edges and diagonals instead
// (mass_tensor.h).
//
// To add a model: a word in the list of `model`, and its interactions in make_elasticity().
#pragma once

#include "sim/mechanics/element_law.h"

namespace rend {

struct MassTensorRequest;

enum class ContinuumModel { Linear, Corotational, MassTensor };

struct ElasticitySettings {
  ContinuumModel model = ContinuumModel::Corotational;
  Formulation formulation = Formulation::Plain; // of quads and hexahedra
  double young = 0;                             // E [Pa]
  double poisson = 0.3;                         // ν
  std::optional<double> thickness = {};         // [m], of a sheet
  Rotation rotation = Rotation::Polar;
  double damping_mass = 0;      // Rayleigh's α [1/s]
  double damping_stiffness = 0; // Rayleigh's β [s]
  Cumulated cumulated = Cumulated::Auto;
  SettingsSource source = {};
};
template <> const Fields<ElasticitySettings>& fields_of();

// Adds the embeddings to the map. UserError: an element without volume, by its name and place; a sheet without
// thickness, or a solid with one; no element of a supported shape. `notes`: messages for the author of the
// preset. `awaited` takes the interactions of the kinds of elements that are not there; null: none ever will
// be.
std::vector<std::unique_ptr<Interaction>> make_elasticity(EmbeddedMap& map, const ElasticitySettings& settings,
                                                          std::vector<std::string>& notes,
                                                          std::vector<AwaitedInteraction>* awaited = nullptr);

// The linear elements that mass-tensors are assembled from, for evaluating stress and forces: of the kinds that
// are there, and in a map that grows of all kinds. They are not embedded: the values of a unit are computed on
// request and valid until the next request.
std::vector<std::unique_ptr<Interaction>> linear_elements(const EmbeddedMap& map,
                                                          const MassTensorRequest& request);

[[noreturn]] void refuse_flat_element(const Place& place, const ElementShape& shape,
                                      const std::vector<Vec3>& rest);

} // namespace rend
