#include "sim/fracture/change.h"

namespace rend {

const std::vector<ChangeType>& all_changes() {
  static const std::vector<ChangeType> list{separate(), delete_element(), split_vertex(), delete_edge(), cut()};
  return list;
}

const ChangeType* find_change(std::string_view name) {
  for (const ChangeType& type : all_changes())
    if (type.name == name) return &type;
  return nullptr;
}

} // namespace rend
