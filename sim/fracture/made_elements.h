// Whether what a rule has made of a body's elements may stay. It is asked while the edit is open, so that one
// change can be refused instead of the whole edit.
//
//   closed       no link is free within an element
//   of a kind    a face has three sides at least; a volume is a tetrahedron, hexahedron, prism or pyramid, as
//                in mesh files and after <apply>; and where the body has elasticity, a face is a triangle or
//                a quad: what no element fits would be a hole in the material
//   in shape     at rest neither flat, folded nor inverted (sim/rules/rest_measures.h), by the same functions
//                that give elements of elasticity their values when the edit closes
//   of matter    it comes from elements that were there: a new one beside them would bring its own mass
//
// So the mass of a body changes by deletion alone. What only separates or sews elements changes none, and is
// not looked at.
#pragma once

#include "sim/fracture/criterion.h"
#include "sim/mechanics/element_law.h"
#include "sim/rules/script_run.h"

#include <memory>
#include <string>
#include <vector>

namespace rend {

class MadeElements {
public:
  // `request`: of the body, for its elasticity; null: it has none.
  MadeElements(const RuleOrScript& what, int dimension, const CriterionRequest* request);

  bool unchanged() const { return !relinks_ && !moves_; } // whether the rule leaves all elements as they are

  void begin(); // an edit
  // Why the last application of the runner may not stay, in words that name no place, so that refusals can be
  // counted; empty: it may.
  std::string fault(Edit& edit, RuleOrScriptRunner& runner);

private:
  void look_through(const RuleOrScript& what, int dimension);
  void note_moves(const Edit& edit, RuleOrScriptRunner& runner);
  void keep_moves();
  void find_changed(const Edit& edit, RuleOrScriptRunner& runner);
  std::string fault_of_changed(Edit& edit, bool known_in_shape) const;
  const char* fault_of_links(const Edit& edit) const;
  const char* fault_of_origin(const Edit& edit) const;
  bool fits_elasticity(const Edit& edit) const;
  bool is_moved(Dart d) const;
  Vec3 rest_of(const Edit& edit, Dart d) const;

  bool relinks_ = false; // it creates or removes darts, or changes links within elements
  bool moves_ = false;   // it moves vertices that were there
  // Of the body's elasticity, one for each kind; empty: none.
  std::vector<std::shared_ptr<const ElementLaw>> laws_;
  IndexMap moved_;                           // dart → index in rest_of_moved_: of earlier changes of the edit
  IndexMap moving_;                          // the same, of the change that was just made
  std::vector<Vec3> rest_of_moved_;          // [m]
  std::vector<Dart> moving_darts_, changed_; // scratch
  mutable std::vector<Dart> element_;        // scratch: the darts of the element that is looked at
};

} // namespace rend
