// Finite elements as they lie in the map: their kinds, the words from an owner's first dart to their corners,
// and what the shape functions give at rest.
//
// With N_n the shape functions over a reference element and r_n the rest positions, at each integration point
//
//   J = Σ r_n ∇̂N_nᵀ,   G_n = J⁻ᵀ ∇̂N_n,   F = Σ x_n G_nᵀ = (Σ x_n ∇̂N_nᵀ) J⁻¹,   w = |det J| ŵ
//
// so that J⁻¹ and w are all that an element carries, ten numbers of a tetrahedron. The ∇̂N_n are the same for
// all of a kind. Reference elements (corners as the words find them): [0,1]² and [0,1]³ for quads and
// hexahedra, the unit triangle and tetrahedron, their product with [0,1] for a prism. A pyramid is a cube whose
// top is drawn together to the apex: the rational shape functions of 5 nodes, for which 2 × 2 × 2 points are
// exact on every pyramid with a flat parallelogram as base.
//
// Where the corners are counted the other way round, det J is negative, and gradients come out the same.
#pragma once

#include "sim/mechanics/interaction.h"

#include <optional>
#include <string>
#include <vector>

namespace rend {

enum class ElementKind { Triangle, Quad, Tetrahedron, Hexahedron, Prism, Pyramid };
constexpr int element_kinds = 6;

// A point of the reference element.
struct ReferencePoint {
  double weight;
  std::array<std::array<double, 3>, most_particles> gradient; // ∇̂N_n of corner n; of a sheet the third is 0
};

struct ElementShape {
  ElementKind kind;
  std::string name, plural; // "tetrahedron", "tetrahedra"
  int dimension;            // 2: of a sheet
  int corners;
  int darts; // of the whole element
  std::vector<std::vector<Word>>
      units;                          // to the corners, one for each kind of place where the first dart may lie
  std::vector<ReferencePoint> points; // 2 × 2 × 2 ones in the order of bits: ξ fastest
  int values() const { return static_cast<int>(points.size()) * (dimension * dimension + 1); }
};

const ElementShape& shape_of(ElementKind kind);

// The element that d lies in (its <0,1> in a sheet, its <0,1,2> in a solid), and which unit's words lead from d
// to its corners. None: it is open, or of another kind.
struct ElementPlace {
  ElementKind kind;
  std::size_t unit;
  Dart first; // the smallest dart of the element
};
std::optional<ElementPlace> element_at(const GMap& map, Dart d);

// Whether d is where this unit of this kind starts from: a Pattern's `present`.
template <ElementKind kind> bool element_present(const GMap& map, Dart d, std::size_t unit) {
  const std::optional<ElementPlace> place = element_at(map, d);
  return place && place->kind == kind && place->unit == unit;
}

// Of a sheet's element: its columns are the direction of the first edge, the one across it in the plane, and
// the normal, that of the area vector (a warped quad's mean gradient then lies in that plane). Of a solid's:
// the first edge, the side of the last edge of the first face, and what makes it right-handed.
Eigen::Matrix3d rest_frame(const ElementShape& shape, const Vec3* rest);

// Writes J⁻¹ (dimension × dimension, row by row) and w of each point, one point after another: shape.values()
// numbers. Rest axes are the columns of `frame`; of a sheet the first two, and w [m³] is area times thickness.
// False: the element has no volume, or is folded, and all are 0.
bool write_element(const ElementShape& shape, const Vec3* rest, const Eigen::Matrix3d& frame, double thickness,
                   double* values);

} // namespace rend
