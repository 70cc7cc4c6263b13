// The parameter table as a flat list, for help and the schema.
#pragma once

#include "sim/base/parameters.h"

#include <string>
#include <vector>

namespace rend {

// A position at which an element may occur.
struct TablePlace {
  std::string path; // "scene.body.sheet"
  int at_least = 1, at_most = 1;
};

// An element type; listed once even if several elements share it.
struct TableEntry {
  const ElementType* type;
  std::vector<TablePlace> places; // in the order of the table; not empty

  const std::string& path() const { return places.front().path; }
};

// All types below `root`, itself first, parents before children, in the order of the table.
std::vector<TableEntry> table_entries(const ElementType& root);

} // namespace rend
