// The content of a Gmsh file, independent of its version and encoding, collected while it is read and turned
// into a mesh.
//
// With solid elements the mesh is a solid; the faces among its elements must then be faces of solids and only
// define groups. Without solid elements, triangles and quads make a sheet. Lines and points only define groups.
// A physical group is named by its name, or by its number if it has none; groups of one name in several
// dimensions are united.
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
  void close_nodes(); // after the last node
  bool has_nodes() const { return closed_; }

  // `groups` are physical numbers. Fails if a node does not exist.
  void add_element(const MshType& type, const Origin& origin, std::span<const std::uint64_t> nodes,
                   std::span<const int> groups);

  // Fills in the file's mesh, origins and groups. Fails for faces that belong to no solid, and if there is no
  // element.
  void finish();

private:
  struct Element {
    const MshType* type;
    std::uint32_t first; // in corners_
    int group;           // its first group, 0: none
  };
  std::uint32_t node(std::uint64_t tag, const Origin& origin, const MshType& type) const;
  std::vector<bool> repeats(int dimension) const;
  void check_faces(const CellMesh& cells) const;

  MeshFile& file_;
  std::vector<Vec3> points_;
  std::vector<std::uint64_t> tags_;   // of each point
  std::vector<std::size_t> offsets_;  // of each point, until close_nodes()
  std::vector<std::uint32_t> dense_;  // tag → point, if tags have few gaps
  std::vector<std::uint32_t> by_tag_; // otherwise: points by increasing tag
  bool closed_ = false;
  std::vector<Element> elements_; // of dimension 2 and 3
  std::vector<Origin> origins_;   // of each
  std::vector<std::uint32_t> corners_;
  std::map<std::pair<int, int>, std::string> names_; // (dimension, physical)
  std::map<std::pair<int, int>, std::vector<std::uint32_t>> groups_;
  std::size_t members_ = 0; // of all groups
};

} // namespace rend
