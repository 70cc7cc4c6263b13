// All rules, each in a file of its own with a drawing. To add one, list it in all_rules() (rules.cpp).
//
// Any dart of the orbit named here may be the hook: the resulting map is the same.
#pragma once

#include "sim/rules/apply.h"

#include <vector>

namespace rend {

// clang-format off
//                                                hooks                                      arguments     fig.
// Construction.
extern const Rule create_vertex;               // none                                       a point       3.36
extern const Rule create_edge;                 // a vertex without edge                      a point       3.37
extern const Rule extrude_edge;                // an edge without face                       a vector      3.39
extern const Rule create_triangle;             // none                                       three points  3.46
extern const Rule create_quad;                 // none                                       four points   3.46
extern const Rule sew_edges;                   // two edges of faces, α2-free: dart to dart                3.20
extern const Rule sew_faces;                   // two faces of volumes, α3-free: dart to dart
// Refinement.
extern const Rule insert_vertex_border;        // an edge of one face                                      3.18
extern const Rule insert_vertex;               // any edge
extern const Rule triangulate_face;            // a face of a sheet, or of a solid's hull                  3.29
extern const Rule triangulate_face_both_sides; // any face
extern const Rule subdivide;                   // a component of a sheet                                   3.44
// Separation.
extern const Rule unsew_edge;                  // an edge between two faces                                3.48
extern const Rule unsew_face;                  // a face between two volumes                               7.5
// Removal.
extern const Rule remove_isolated_face;        // a face of a sheet without neighbours                     3.47
extern const Rule remove_inner_face;           // a face of a sheet with faces on all sides                3.50
extern const Rule remove_isolated_volume;      // a volume without neighbours
// clang-format on

const std::vector<const Rule*>& all_rules();

// A face with as many sides as there are points (at least three), free on all sides; returns two darts per
// side, d and α0(d), side by side: d is at the point of its side. As fig. 3.46, for any number of sides.
std::vector<Dart> create_polygon(Edit& edit, std::span<const Point> points);

// Removes a face from a sheet, or a volume from a solid, whatever it is sewn to: separations, then a removal.
void remove_element(Edit& edit, Dart d);

} // namespace rend
