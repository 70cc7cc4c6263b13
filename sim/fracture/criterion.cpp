#include "sim/fracture/criterion.h"

namespace rend {

const std::vector<CriterionType>& all_criteria() {
  static const std::vector<CriterionType> list{
      atomic_spring(),           atomic_element(), atomic_vertex(), cumulative_vertex(),
      vertex_stress_criterion(), atomic_border(),  global_border(), strain()};
  return list;
}

const CriterionType* find_criterion(std::string_view name) {
  for (const CriterionType& type : all_criteria())
    if (type.name == name) return &type;
  return nullptr;
}

} // namespace rend
