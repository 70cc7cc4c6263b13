// Whether the elements that a change makes are such that the body's elasticity can be put on them: neither flat
// nor folded. It is asked while the edit is open, by the same functions that give elements their values when it
// closes (sim/mechanics/elasticity.h), so that a change can be refused instead of the whole edit.
#pragma once

#include "sim/fracture/criterion.h"
#include "sim/mechanics/element_law.h"

#include <functional>
#include <memory>
#include <vector>

namespace rend {

class ElementFit {
public:
  explicit ElementFit(const CriterionRequest& request);

  bool empty() const { return laws_.empty(); } // the body has no elasticity, which any element can bear
  // Of the element of d; `rest_of`: the rest position that the vertex of a dart will have.
  bool fits(const GMap& map, Dart d, const std::function<Vec3(Dart)>& rest_of) const;

private:
  std::vector<std::shared_ptr<const ElementLaw>> laws_; // at most one for each kind of element
};

} // namespace rend
