// Selectors: which vertices settings are about, by their rest positions after the body was placed.
//
//   near="x y z"                 the closest vertex
//   box="x0 y0 z0 x1 y1 z1"      those within, or within 1e-9 of the body's size of it: grid lines are rounded
//   side="-x" ... "+z"           those at that end of the body, within 1e-9 of its size
//   group="name"                 those of a group that the body's mesh file names
//   all="yes"
#pragma once

#include "sim/base/settings.h"
#include "sim/embedding/embedded_map.h"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rend {

// Exactly one of them.
struct Selector {
  std::optional<Vec3> near = {};                 // [m]
  std::optional<std::array<double, 6>> box = {}; // [m], two opposite corners
  std::string side = {};                         // "-x", "+x", "-y" ...; empty: not by side
  std::string group = {};                        // empty: not by group
  std::optional<bool> all = {};                  // false selects nothing, which is refused

  bool given() const; // one of them is
};
template <> const Fields<Selector>& fields_of();

using VertexGroups = std::map<std::string, std::vector<Slot>>; // of a mesh file: increasing slots

// Increasing slots. `element`: what selects, for messages: "fix"; `source`: its settings'. UserError: no
// selector, several, or one that selects nothing.
std::vector<Slot> select_vertices(const EmbeddedMap& map, const VertexGroups& groups, const Selector& selector,
                                  const std::string& element, const SettingsSource& source);

// Increasing. UserError, at this attribute: there is no such group.
const std::vector<Slot>& vertices_of_group(const VertexGroups& groups, const std::string& name,
                                           std::string_view attribute, const SettingsSource& source);

} // namespace rend
