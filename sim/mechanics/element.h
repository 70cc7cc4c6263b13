// Finite elements in the map: their kinds, the words from an owner's first dart to their corners, and the
// derivatives of their shape functions at rest.
//
// With N_n the shape functions over a reference element and r_n the rest positions, at each integration point
//
//   J = Σ r_n ∇̂N_nᵀ,   G_n = J⁻ᵀ ∇̂N_n,   F = Σ x_n G_nᵀ = (Σ x_n ∇̂N_nᵀ) J⁻¹,   w = |det J| ŵ
//
// so that an element stores only J⁻¹ and w, ten numbers for a tetrahedron. The ∇̂N_n are the same for all
// elements of a kind. Reference elements (with corners in the order of the words): [0,1]² and [0,1]³ for quads
// and hexahedra, the unit triangle and tetrahedron, their product with [0,1] for a prism. A pyramid is a cube
// whose top is collapsed to the apex: rational shape functions of 5 nodes, whose F is constant on each line
// through the apex. 2 × 2 points of the base stand for 2 × 2 × 2, and are exact on every pyramid with a planar
// parallelogram as base.
//
// If the corners are numbered with the opposite orientation, det J is negative and the gradients are the same.
#pragma once

#include "sim/mechanics/interaction.h"

#include <optional>
#include <string>
#include <vector>

namespace rend {

enum class ElementKind { Triangle, Quad, Tetrahedron, Hexahedron, Prism, Pyramid };
constexpr int element_kinds = 6;

// An integration point of the reference element.
struct ReferencePoint {
  double weight;
  // ∇̂N_n of corner n; in a sheet the third component is 0
  std::array<std::array<double, 3>, most_particles> gradient;
};

struct ElementShape {
  ElementKind kind;
  std::string name, plural; // "tetrahedron", "tetrahedra"
  int dimension;            // 2: sheet
  int corners;
  int darts; // of the whole element
  // words to the corners, one list for each non-equivalent position of the first dart
  std::vector<std::vector<Word>> units;
  std::vector<ReferencePoint> points; // of squares and cubes: ξ varies fastest
  int values() const { return static_cast<int>(points.size()) * (dimension * dimension + 1); }
};

const ElementShape& shape_of(ElementKind kind);

// The element of d (its <0,1> in a sheet, its <0,1,2> in a solid), and which unit's words lead from d to its
// corners. nullopt: it is not closed, or of none of the kinds.
struct ElementPlace {
  ElementKind kind;
  std::size_t unit;
  Dart first; // the smallest dart of the element
};
std::optional<ElementPlace> element_at(const GMap& map, Dart d);

// Whether this unit of this kind starts from d: a Pattern's `present`.
template <ElementKind kind> bool element_present(const GMap& map, Dart d, std::size_t unit) {
  const std::optional<ElementPlace> place = element_at(map, d);
  return place && place->kind == kind && place->unit == unit;
}

// For an element of a sheet the columns are the direction of the first edge, the in-plane direction normal to
// it, and the normal, along the area vector (the mean gradient of a warped quad lies in that plane). For an
// element of a solid: the first edge, the in-plane direction towards the last edge of the first face, and the
// vector that makes the frame right-handed.
Eigen::Matrix3d rest_frame(const ElementShape& shape, const Vec3* rest);

// Writes J⁻¹ (dimension × dimension, row by row) and w of each integration point, point by point:
// shape.values() numbers. Rest axes are the columns of `frame`, for a sheet the first two; its w [m³] is area
// times thickness. False: the element has no volume, or is folded, and all values are 0.
bool write_element(const ElementShape& shape, const Vec3* rest, const Eigen::Matrix3d& frame, double thickness,
                   double* values);

} // namespace rend
