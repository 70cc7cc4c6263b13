// The facts that `rend mesh info` prints about a mesh.
#pragma once

#include "sim/mechanics/element_quality.h"
#include "sim/mesh/reader.h"
#include "sim/topology/count.h"

#include <nlohmann/json_fwd.hpp>

#include <map>
#include <string>
#include <vector>

namespace rend {

struct MeshFacts {
  std::string file;
  int dimension = 2; // of a sheet; 3: of a solid
  CellCounts counts;
  std::size_t darts = 0;
  std::map<std::string, std::size_t> elements; // by kind: "quads"
  Vec3 low, high;                              // [m], corners of the bounding box
  double extent = 0;                           // [m²] of a sheet, [m³] of a solid
  MeshQuality quality;
  std::map<std::string, std::size_t> groups; // vertices of each
  std::vector<std::string> notes;

  bool solid() const { return dimension == 3; }
};
MeshFacts mesh_facts(const MeshBody& body, const std::string& file);

// How many elements of a solid are slivers, with dihedral angles below 10 or above 160 degrees, and the worst.
std::string slivers_in_words(const EmbeddedMap& map);

nlohmann::ordered_json json_of(const MeshFacts& facts);
std::string facts_in_words(const MeshFacts& facts);

} // namespace rend
