#include "sim/fracture/criterion.h"

namespace rend {

const std::vector<CriterionType>& all_criteria() {
  static const std::vector<CriterionType> list{
      atomic_spring(),           atomic_element(), atomic_vertex(), cumulative_vertex(),
      vertex_stress_criterion(), atomic_border(),  global_border(), strain()};
  return list;
}

} // namespace rend
