// The parameter table laid out as a list, for those who print all of it: help and the schema.
#pragma once

#include "sim/base/parameters.h"

#include <string>
#include <vector>

namespace rend {

// Where an element may stand.
struct TablePlace {
  std::string path; // "scene.body.sheet"
  int at_least = 1, at_most = 1;
};

// An element type, once, however many elements share it.
struct TableEntry {
  const ElementType* type;
  std::vector<TablePlace> places; // in the order of the table; not empty

  const std::string& path() const { return places.front().path; }
};

// All types below `root`, itself first, parents before children, in the order of the table.
std::vector<TableEntry> table_entries(const ElementType& root);

} // namespace rend
