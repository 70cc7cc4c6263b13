// Patches: the faces, edges or corners of a body on which an external load acts.
//
// The nodal forces of a traction t [N/m²] on a polygon are ∫ N_i t dA: expressed by a vector area for each
// corner,
//
//   triangle       a third of its vector area
//   quad           ∫ N_i x_ξ × x_η dξ dη, exact for the bilinear surface through its corners, warped or not
//   other polygon  the triangles around its mean point; the share of that point is divided among all corners
//
// (consistent nodal loads: Zienkiewicz & Taylor, The Finite Element Method, vol. 1). They sum up to the vector
// area ½ Σ x_i × x_{i+1}, and an edge gives half its length to each end.
#pragma once

#include "sim/base/bytes.h"
#include "sim/outside/share.h"

#include <span>
#include <utility>
#include <vector>

namespace rend {

// The vector area [m²] of each corner of the polygon x, listed counter-clockwise; same length.
void corner_areas(std::span<const Vec3> x, std::span<Vec3> area);

// Cells with their vertices, flat.
class CellList {
public:
  void clear();
  void add(std::span<const Slot> vertices);

  std::size_t size() const { return first_.size() - 1; }
  std::span<const Slot> operator[](std::size_t cell) const {
    return std::span(vertices_).subspan(first_[cell], first_[cell + 1] - first_[cell]);
  }
  std::size_t first(std::size_t cell) const { return first_[cell]; } // index of its first vertex in vertices()
  const std::vector<Slot>& vertices() const { return vertices_; }    // of all cells, cell by cell
  std::size_t bytes() const { return bytes_of(first_) + bytes_of(vertices_); }

private:
  std::vector<std::size_t> first_{0};
  std::vector<Slot> vertices_;
};

class Patch {
public:
  enum class Kind { Faces, Edges, Corners };

  // For a solid the α3-free faces, for a sheet the α2-free edges, all of whose vertices are given. If there are
  // none, the corners of those vertices, with equal shares.
  static Patch boundary(EmbeddedMap& map, const std::string& name, const std::vector<Slot>& vertices);

  // For a solid the α3-free faces, for a sheet the faces, all of whose vertices are given; there may be none.
  // The faces of a solid are oriented counter-clockwise as seen from outside; those of a sheet as its cells are
  // listed.
  static Patch faces(EmbeddedMap& map, const std::string& name, const std::vector<Slot>& vertices);

  void rebind(const EmbeddedMap& map); // after edits

  Kind of() const { return of_; }
  const CellList& cells() const { return cells_; }
  const std::vector<Dart>& darts() const { return darts_; }               // one dart of each cell
  std::size_t bytes() const { return cells_.bytes() + bytes_of(darts_); } // without the embedding

  // The share of each of cells().vertices(), at rest: area [m²], length [m], or, for corners, their share of 1.
  std::vector<double> measures(const EmbeddedMap& map) const;

private:
  using Found = std::vector<std::pair<Slot, double>>; // cells and their shares
  static Found find_faces(EmbeddedMap& map, const std::vector<Slot>& vertices);
  static Found find_edges(EmbeddedMap& map, const std::vector<Slot>& vertices);
  static Patch of_cells(EmbeddedMap& map, const std::string& name, Orbit orbit, const Found& found);

  Patch(Kind of, ShareColumn& shares, const EmbeddedMap& map) : of_(of), shares_(&shares) { rebind(map); }
  Kind of_;
  ShareColumn* shares_; // 0: not in the patch; faces: −1: reversed orientation
  CellList cells_;
  std::vector<Dart> darts_;
};

} // namespace rend
