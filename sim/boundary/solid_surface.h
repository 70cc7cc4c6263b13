// The boundary surface of a solid: its α3-free faces as triangles, with the edges of cells marked, and their
// normals.
//
// Faces are bound one by one, rebuilt only where the map changed, with a result equal to a full rebuild
// (boundary_faces.h). They are oriented counter-clockwise as seen from outside, which follows from the rest
// state and not from how the map was built; so back faces need not be drawn.
//
// Corners around a vertex share a normal unless a crease separates them, so that a coarse mesh of a smooth
// shape looks smooth: the fan of corners around a vertex (hull.h) is divided into groups by creases, edges
// where the normals of two faces differ by more than 40° at rest. (At rest, or creases would come and go as the
// body bends.) A face exposed by fracture is shaded flat, in a group of its own. The normal of a group is, over
// its corners with the edge vectors a and b,
//
//   n ~ Σ a × b / (|a|² |b|²),
//
// exact for points on a sphere (Max, Weights for computing vertex normals, 1999), and needs no angles. Nothing
// is stored for inner faces.
#pragma once

#include "sim/boundary/boundary_faces.h"
#include "sim/boundary/boundary_triangle.h"
#include "sim/embedding/initial_border.h"
#include "sim/topology/marks.h"

namespace rend {

class SolidSurface {
public:
  SolidSurface(EmbeddedMap& map,
               const BorderColumn* border); // CHECK: a solid. border: null if the body cannot tear
  ~SolidSurface();
  SolidSurface(const SolidSurface&) = delete;
  SolidSurface& operator=(const SolidSurface&) = delete;

  bool update(); // after edits; costs as much as they touched; false: there were none

  std::size_t faces() const { return boundary_.count(); }
  std::size_t triangles() const { return boundary_.corner_count() - 2 * boundary_.count(); }

  // Calls f(BoundaryFaces::Face, std::span<const BoundaryFaces::Corner>) by smallest darts.
  template <class F> void for_each_face(F&& f) const { boundary_.for_each(std::forward<F>(f)); }

  // Calls f(BoundaryTriangle), face after face by their smallest darts.
  template <class F> void for_each_triangle(F&& f) const {
    std::uint32_t base = 0;
    boundary_.for_each([&](const BoundaryFaces::Face& face, std::span<const BoundaryFaces::Corner> corner) {
      const auto kind = [&](std::uint32_t k) { return corner[k].side; };
      for (std::uint32_t number = 0; number < fan_size(face.sides); ++number) {
        const auto [a, b, c] = fan_corners(number);
        f(BoundaryTriangle{.vertex = {corner[a].vertex, corner[b].vertex, corner[c].vertex},
                           .normal = {base + a, base + b, base + c},
                           .side = fan_lines(number, face.sides, kind),
                           .first = face.first,
                           .number = number,
                           .turned = face.turned,
                           .exposed = face.exposed});
      }
      base += face.sides;
    });
  }

  // Normals of the current state, unit and outward, or 0 if undefined; one per corner of a boundary face.
  void normals(std::vector<Vec3>& out);

  std::size_t bytes() const { return boundary_.bytes() + numbers_.size() * sizeof(std::uint32_t); }
  bool same_as(const SolidSurface& other) const { return boundary_ == other.boundary_; }

private:
  struct FanCorner {
    Dart even, odd; // its two darts
    Vec3 area;      // of its face at rest
    bool exposed;
  };

  void rebuild();
  void queue(Dart d);             // queues the face of d, if it is on the boundary
  void queue_around_edge(Dart d); // the two hull faces at the edge
  void queue_volume(Dart d);      // the boundary faces of d's volume, and their neighbours
  void empty_queue();             // and clears its marks
  void bind();                    // rebuilds the queued faces
  void write_face(Dart first);
  void write_fan(Dart d);
  void collect_fan(Dart d);
  void write_group(std::size_t begin, std::size_t end); // of the fan, indices modulo its size
  bool exposed(Dart d) const;
  LineKind line_kind_of(Dart d, const Vec3& area) const;
  FanCorner fan_corner(Dart even, Dart odd) const;
  void number_groups();

  EmbeddedMap& map_;
  const BorderColumn* border_;
  BoundaryFaces boundary_;
  Changes changes_;
  std::vector<std::uint32_t> numbers_; // of its group, one per corner of a boundary face
  std::size_t groups_ = 0;
  bool numbered_ = false;  // whether numbers_ belong to the current boundary_
  std::vector<Vec3> sums_; // one per group

  // Scratch of update().
  std::vector<Dart> queue_;   // smallest darts of the faces to rebuild
  Marks queued_;              // on their darts
  std::vector<Dart> volumes_; // darts of volumes that were queued
  Marks in_volumes_;          // marks on those
  std::vector<FanCorner> fan_;
  bool fan_closed_ = false;
};

} // namespace rend
