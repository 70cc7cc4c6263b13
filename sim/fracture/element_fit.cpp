#include "sim/fracture/element_fit.h"

#include "sim/mechanics/mass_tensor.h"
#include "sim/topology/walk.h"

namespace rend {
namespace {

// Mass-tensors are made of linear elements, of all kinds.
void add_linear_laws(const ElasticMaterial& material, int dimension,
                     std::vector<std::shared_ptr<const ElementLaw>>& laws) {
  for (int kind = 0; kind < element_kinds; ++kind) {
    auto law = element_law(static_cast<ElementKind>(kind), ElasticModel::Linear, Rotation::Polar, material);
    if (law->shape().dimension == dimension) laws.push_back(std::move(law));
  }
}

} // namespace

ElementFit::ElementFit(const CriterionRequest& request) {
  for (const auto& interaction : request.interactions) {
    if (auto law = std::dynamic_pointer_cast<const ElementLaw>(interaction->law))
      laws_.push_back(std::move(law));
    const auto* tensors = dynamic_cast<const MassTensorLaw*>(interaction->law.get());
    if (tensors && laws_.empty()) add_linear_laws(tensors->request().material, request.map.dimension(), laws_);
  }
}

bool ElementFit::fits(const GMap& map, Dart d, const std::function<Vec3(Dart)>& rest_of) const {
  const Dart first = smallest_dart(map, element_orbit(map.dimension()), d); // from which values are written
  const std::optional<ElementPlace> at = element_at(map, first);
  if (!at) return true;
  std::vector<Vec3> rest;
  for (const auto& word : shape_of(at->kind).units[at->unit]) rest.push_back(rest_of(map.follow(first, word)));
  constexpr double thickness = 1; // [m], which does not matter here
  for (const auto& law : laws_) {
    if (law->shape().kind != at->kind) continue;
    std::vector<double> values(static_cast<std::size_t>(law->values()));
    if (!law->write_unit(rest.data(), thickness, values.data())) return false;
  }
  return true;
}

} // namespace rend
