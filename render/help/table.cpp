#include "render/help/table.h"

#include <algorithm>

namespace rend {
namespace {

void collect(const ElementType& type, const TablePlace& place, std::vector<TableEntry>& out) {
  const auto known =
      std::find_if(out.begin(), out.end(), [&](const TableEntry& one) { return one.type == &type; });
  if (known != out.end()) {
    known->places.push_back(place);
    return; // its children are listed already
  }
  out.push_back({&type, {place}});
  for (const ChildType& child : type.children)
    collect(*child.type, {place.path + "." + child.type->name, child.at_least, child.at_most}, out);
}

} // namespace

std::vector<TableEntry> table_entries(const ElementType& root) {
  std::vector<TableEntry> out;
  collect(root, {root.name, 1, 1}, out);
  return out;
}

} // namespace rend
