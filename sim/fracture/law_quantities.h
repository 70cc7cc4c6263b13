// What the expressions of a rule ask of the law that applies it (RuleQuantities).
//
//   of an element   the largest principal value of σ [Pa] or ε: what atomic-element and strain measure
//   at a vertex     that of Σ m σ / Σ m over the elements around it, m their masses (thesis 7.2): what
//                   vertex-stress measures; likewise of ε
//
// With compression="yes" of the law it is the largest by size, as a magnitude, as of its criterion.
//
// All are of the state and the map before the first change of the edit, in which a law makes all changes of a
// step: so the order of changes, where places lie apart, does not matter. They are evaluated when first asked
// for, also after changes: rows are bound again only when the edit is closed, and links are remembered
// (OldLinks). What the same edit has changed already has the value of what it was: an element, or a vertex,
// that of its smallest dart from before the edit. What was born has the mean of its parents' values.
#pragma once

#include "sim/embedding/inheritance.h"
#include "sim/fracture/continuum_rows.h"
#include "sim/rules/rule_values.h"

#include <array>
#include <optional>

namespace rend {

class LawQuantities final : public RuleQuantities {
public:
  // Without stresses and strains.
  LawQuantities() = default;
  // CHECK: the body has continuum elements.
  explicit LawQuantities(const CriterionRequest& request);

  void begin(const ForceView& view);    // before the first change of an edit
  void before_change(const Edit& edit); // before each

  double stress(const Edit& edit, Dart d, Of of) override { return largest(fields_[0], edit, d, of); }
  double strain(const Edit& edit, Dart d, Of of) override { return largest(fields_[1], edit, d, of); }

  void rebind(const Changes& changes);
  void reserve_for_separations();
  std::size_t bytes() const;

private:
  // The tensors of an element: mostly a single one.
  struct OfElement {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    int count = 0, corners = 0;
    double largest = 0; // principal value
  };
  struct Field { // of σ or ε
    Eigen::Matrix3d (ElementLaw::*tensor)(const double*, const UnitState&) const;
    IndexMap element, vertex; // slot → index in the lists of those that were evaluated since begin()
    std::vector<OfElement> of_element;
    std::vector<double> at_vertex; // largest principal values
  };
  double largest(Field& field, const Edit& edit, Dart d, Of of);
  double from_before(Field& field, const Edit& edit, Dart d, Of of); // of a dart from before the edit
  const OfElement& of_element(Field& field, Dart d);
  double at_vertex(Field& field, const Edit& edit, Dart d);
  void add(OfElement& sum, const Field& field, std::size_t part, std::size_t row);

  std::array<Field, 2> fields_{{{&ElementLaw::stress, {}, {}, {}, {}}, {&ElementLaw::strain, {}, {}, {}, {}}}};
  const EmbeddedMap* map_ = nullptr;
  const MassColumn* mass_ = nullptr;
  Compression compression_ = Compression::Ignored;
  std::optional<ContinuumRows> rows_; // none: nobody asks for stresses
  std::optional<ForceView> view_;
  std::optional<OldLinks> old_links_;
  MapEdit::Savepoint noted_;   // up to which old_links_ knows
  std::vector<Dart> darts_;    // scratch: of an orbit as it is now
  std::vector<Dart> corners_;  // scratch: of a vertex as it was
  std::vector<double> values_; // scratch: of a row
};

} // namespace rend
