// The boundary of a body: the faces that can be seen, touched and exported. Which faces these are, in which
// order they come and how each is walked is found here; contact, exports and pictures take what they need of it
// (Body::boundary()).
//
// Of a sheet these are all faces, of a solid the α3-free ones (outer_faces.h, solid_surface.h). What only
// pictures need of a sheet, triangles with their sides and normals (surface.h), is there once somebody asks for
// it.
//
// Everything is brought up to date after changes of the map by update(), from the places that changed, and is
// then what it would be if it were made anew: when and how often that is done leaves no trace.
#pragma once

#include "sim/boundary/face_sense.h"
#include "sim/boundary/outer_faces.h"
#include "sim/boundary/solid_surface.h"
#include "sim/boundary/surface.h"

#include <optional>

namespace rend {

class Boundary {
public:
  Boundary(EmbeddedMap& map, const BorderColumn* border); // border: null where nothing tears
  ~Boundary();
  Boundary(const Boundary&) = delete;
  Boundary& operator=(const Boundary&) = delete;

  void update();                              // after edits; does nothing where there were none
  long revision() const { return revision_; } // grows with each update that had something to do

  // Calls f(BoundaryFaces::Face, std::span<const Slot> vertices), face after face by their smallest darts (of a
  // sheet by their slots, which is the same until an edit makes new faces). Vertices come in the order in which
  // the face is walked, from that of its smallest dart on; in a turned face of a sheet that one is the last.
  template <class F> void for_each_face(F&& f) const {
    std::vector<Slot> vertices;
    if (solid_) {
      solid_->for_each_face(
          [&](const BoundaryFaces::Face& face, std::span<const BoundaryFaces::Corner> corners) {
            vertices.clear();
            for (const BoundaryFaces::Corner& corner : corners) vertices.push_back(corner.vertex);
            f(face, std::span<const Slot>(vertices));
          });
      return;
    }
    for_each_outer_face(map_, [&](Slot, Dart first) {
      const BoundaryFaces::Face found = face_of_sheet(first, vertices);
      f(found, std::span<const Slot>(vertices));
    });
  }

  // Calls f(BoundaryTriangle): those of a face of a solid one after another, those of a sheet in any order.
  template <class F> void for_each_triangle(F&& f) {
    solid_ ? solid_->for_each_triangle(f) : sheet().for_each_triangle(f);
  }

  Surface& sheet();      // CHECK: of a sheet; made when it is first asked for
  SolidSurface& solid(); // CHECK: of a solid

private:
  BoundaryFaces::Face face_of_sheet(Dart first, std::vector<Slot>& vertices) const;

  EmbeddedMap& map_;
  const BorderColumn* border_;
  const Column<FaceSense>* sense_ = nullptr; // null: fronts are walked from smallest darts
  Changes changes_;                          // of a sheet
  long revision_ = 0;
  std::optional<Surface> sheet_; // none: nobody asked for it
  std::optional<SolidSurface> solid_;
};

} // namespace rend
