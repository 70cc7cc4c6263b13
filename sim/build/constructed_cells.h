// The cells of a body that rules have made: whether they are those that a mesh file may hold, closed faces, and
// volumes that are tetrahedra, hexahedra, prisms or pyramids; and their order.
#pragma once

#include "sim/base/settings.h"
#include "sim/mesh/reader.h"

#include <optional>
#include <string>
#include <vector>

namespace rend {

// The rule since which cells are open.
struct OpenedBy {
  std::string rule; // "rule 'star'"
  SettingsSource source;
};

bool has_open_cells(const GMap& map);

// UserError: a cell that is none of those; `shape`: what is to blame if no rule is.
void check_cells(const MapMesh& mesh, const SettingsSource& shape, const std::optional<OpenedBy>& opened);

// Face by face, in the order of smallest darts; each side by side, all in the sense of the component's smallest
// dart, where it has two sides: the fronts of faces are those of the walks from their smallest darts.
std::vector<Dart> face_order(const GMap& map);

} // namespace rend
