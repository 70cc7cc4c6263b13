// What a Gmsh file holds, in whichever of its forms it was written, gathered while it is read, and made a mesh
// of.
//
// Solids make a solid, and then faces among its elements must be faces of solids: they only name groups.
// Without solids, triangles and quads make a sheet. Lines and points only name groups. A physical group is
// called by its name, or by its number where it has none; of one name in several dimensions it is all.
#pragma once

#include "sim/mesh/msh_types.h"
#include "sim/mesh/reader.h"

#include <span>
#include <utility>

namespace rend {

class MshContent {
public:
  explicit MshContent(MeshFile& file) : file_(file) {}

  void name_group(int dimension, int physical, std::string name);
  void add_node(std::uint64_t tag, const Vec3& x, std::size_t offset);
  void close_nodes(); // all are there
  bool has_nodes() const { return closed_; }

  // `groups` are physical numbers. Fails for a node that is not there.
  void add_element(const MshType& type, const Origin& origin, std::span<const std::uint64_t> nodes,
                   std::span<const int> groups);

  // Fills in the file's mesh, origins and groups. Fails for dangling faces, and where there is nothing.
  void finish();

private:
  struct Element {
    const MshType* type;
    std::uint32_t first; // in corners_
    int group;           // its first one, 0: none
  };
  std::uint32_t node(std::uint64_t tag, const Origin& origin, const MshType& type) const;
  std::vector<bool> repeats(int dimension) const;
  void check_faces(const CellMesh& cells) const;

  MeshFile& file_;
  std::vector<Vec3> points_;
  std::vector<std::uint64_t> tags_;   // of each point
  std::vector<std::size_t> offsets_;  // of each point, until all are there
  std::vector<std::uint32_t> dense_;  // tag → point, where tags are nearly without gaps
  std::vector<std::uint32_t> by_tag_; // else points by increasing tag
  bool closed_ = false;
  std::vector<Element> elements_; // of dimension 2 and 3
  std::vector<Origin> origins_;   // of each
  std::vector<std::uint32_t> corners_;
  std::map<std::pair<int, int>, std::string> names_; // (dimension, physical)
  std::map<std::pair<int, int>, std::vector<std::uint32_t>> groups_;
  std::size_t members_ = 0; // of all groups
};

} // namespace rend
