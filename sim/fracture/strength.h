// Where a law of tearing acts, and how strong the body is there:
//
//   value > threshold · s(cell)
//
// s of an element (a face of a sheet, a volume of a solid) is an expression of the place of the element at
// rest (mechanics/element_expression.h), evaluated when the body is built, and for elements that a rule makes
// of nothing when they are made. What is made of one element is as strong as that was, of several as their
// mean; what is merged as the weaker. s of a vertex, an edge or a border is the least of the elements at it:
// what is held by several breaks with the weakest. A law that names a picture, and no strength, has
//
//   s = 0.1 + 0.9 picture        black is a tenth as strong as white
//
// With weibull(m) a body of N elements breaks at its weakest one with the probability
//
//   1 − Π exp(−(v_i/V) (σ/σ₀)^m) = 1 − exp(−(σ/σ₀)^m)        σ₀: threshold; σ: stress, the same everywhere
//
// however fine its mesh is (W. Weibull, A statistical distribution function of wide applicability, J. Appl.
// Mech. 1951), and at a stress that is lower by (V/V')^(1/m) if it is larger than the V' that was given.
//
// Of a body with pieces (piece.h), s is multiplied by the strength of its walls at a border that is a wall,
// and at a vertex that has one, until it has none any more: what holds pieces together breaks before what is
// inside of them. There a law whose change is `separate` opens walls alone, and one that splits or cuts
// vertices parts the pieces from each other (split_vertex.h). Springs along edges, elements, and changes that
// delete know no walls: they hold, or remove, what is inside of a piece.
//
// s of an expression is above 1e-6. A law that selects vertices acts where all vertices of the cell that its
// criterion measures are selected; what it changes there may reach one element beyond. A new vertex is
// selected if all are that it is made of.
#pragma once

#include "sim/embedding/selector.h"
#include "sim/fracture/criterion.h"
#include "sim/fracture/piece.h"
#include "sim/mechanics/element_expression.h"

#include <algorithm>
#include <memory>
#include <optional>

namespace rend {

struct StrengthSettings {
  Selector where = {};                   // none: everywhere
  std::string factor = {};               // s; empty: 1, or that of the picture
  ExpressionSettings of_expression = {}; // its seed and its picture
};
template <> const Fields<StrengthSettings>& fields_of();

// The expression, also where it is that of a picture; nullopt: none. `given`: one is written in a preset.
std::optional<std::string> strength_expression(const StrengthSettings& settings, bool given);

ElementQuantity strength_quantity();

struct ElementStrength {
  using Value = double;
  std::string name = "strength";
  Orbit orbit = FaceOfVolume;
  Orbit support = SingleDart; // what moves its corners does not change it
  std::shared_ptr<const ElementExpression> expression = {};
  Value birth(const EmbeddedMap& map, Dart d) const { return expression->at(map, d); }
  Value split(const Value& whole) const { return whole; }
  Value merge(const Value& kept, const Value& absorbed) const { return std::min(kept, absorbed); }
  Value inherit(const EmbeddedMap&, Dart, std::span<const Inherited<Value>> parents) const {
    return sum_of(parents);
  }
};

// Whether a law may change what lies at a vertex.
struct SelectedVertex {
  using Value = std::uint8_t;
  std::string name = "selected";
  Orbit orbit = Vertex;
  Orbit support = SingleDart;
  Value birth(const EmbeddedMap&, Dart) const { return 0; }
  Value split(const Value& whole) const { return whole; }
  Value merge(const Value& kept, const Value& absorbed) const { return kept & absorbed; }
  Value inherit(const EmbeddedMap&, Dart, std::span<const Inherited<Value>> parents) const {
    Value all = 1;
    for (const Inherited<Value>& parent : parents) all &= parent.value;
    return all;
  }
};

// Of one law on one body.
class Strength {
public:
  // `walls`: their strength; none: they are as strong as all else. Null: it is the same everywhere, and
  // nothing is stored. UserError: as above; no such vertices, or no cell of which all are selected.
  static std::shared_ptr<Strength> of(const StrengthSettings& settings, Cell cell, std::optional<double> walls,
                                      const BodyAtRest& body, const SettingsSource& source);

  void rebind();                          // after a change of the map
  double least() const { return least_; } // of all elements and walls
  // Gives candidates the strength of their cells; drops those that are not above this value relative to it,
  // or not selected.
  void weigh(const EmbeddedMap& map, double above, std::vector<Candidate>& candidates) const;

  bool differs() const { return strength_ || pieces_; } // from place to place; not: it selects alone

private:
  explicit Strength(Cell cell) : cell_(cell) {}
  void select(EmbeddedMap& map, const std::vector<Slot>& vertices, const SettingsSource& source);
  bool is_selected(const EmbeddedMap& map, std::span<const Dart> cell) const;
  double at(const EmbeddedMap& map, std::span<const Dart> cell) const;

  Cell cell_;
  const Column<ElementStrength>* strength_ = nullptr; // null: 1 everywhere
  const CellIndex* elements_ = nullptr;               // null: likewise
  const Column<SelectedVertex>* selected_ = nullptr;  // null: all
  double least_ = 1;
  const PieceColumn* pieces_ = nullptr; // null: walls are as strong as all else
  double wall_ = 1;                     // strength of walls
};

} // namespace rend
