#include "sim/fracture/change.h"

namespace rend {

const std::vector<ChangeType>& all_changes() {
  static const std::vector<ChangeType> list{separate(), delete_element(), split_vertex(), delete_edge()};
  return list;
}

} // namespace rend
