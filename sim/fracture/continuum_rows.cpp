#include "sim/fracture/continuum_rows.h"

namespace rend {

ContinuumRows::ContinuumRows(const CriterionRequest& request) : continuum_(request.map, request.interactions) {
  request.map.use(element_orbit(request.map.dimension()));
  for (const Continuum::Part& part : parts()) {
    std::optional<Binder>& binder = recreated_.emplace_back();
    if (part.index != Continuum::recreated) continue;
    binder.emplace(Binder::of(request.map, *part.interaction, Folding::Off, {}));
    binder->bind();
  }
}

void ContinuumRows::rebind(const Changes& changes) {
  for (auto& binder : recreated_)
    if (binder) binder->rebind(changes);
}

void ContinuumRows::reserve_for_separations() {
  for (auto& binder : recreated_)
    if (binder) binder->reserve_for_separations();
}

std::size_t ContinuumRows::bytes() const {
  std::size_t sum = 0;
  for (const auto& binder : recreated_)
    if (binder) sum += binder->rows().bytes();
  return sum;
}

} // namespace rend
