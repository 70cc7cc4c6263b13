#include "sim/fracture/pairs.h"

#include "sim/base/check.h"

#include <algorithm>

namespace rend {

std::vector<NamedCriterion> named_criteria() {
  std::vector<NamedCriterion> list;
  for (const CriterionType& type : all_criteria()) {
    for (const std::string& kind : type.kinds) list.push_back({&type, kind});
    if (type.kinds.empty()) list.push_back({&type, ""});
  }
  return list;
}

const ChangeType& default_change(Cell cell) {
  const auto found = std::find_if(all_changes().begin(), all_changes().end(),
                                  [&](const ChangeType& type) { return type.cell == cell; });
  CHECK(found != all_changes().end());
  return *found;
}

Pair pair_of(const NamedCriterion& criterion, const ChangeType& change, int dimension) {
  return {criterion, &change, dimension, &transfer(criterion.cell(), change.cell, dimension),
          criterion.without_meaning(dimension)};
}

std::vector<Pair> all_pairs(int dimension) {
  std::vector<Pair> list;
  for (const NamedCriterion& criterion : named_criteria())
    for (const ChangeType& change : all_changes()) list.push_back(pair_of(criterion, change, dimension));
  return list;
}

} // namespace rend
