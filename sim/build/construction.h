// Construction by rules: what <apply> and <subdivide> do to a body's shape before it is placed and given matter
// (thesis 3.5 and chapter 5).
//
//   <body> <sheet cells="2 2" size="1 1"/> <apply rule="quarter-faces" times="3"/> ... </body>
//   <body> <create dimension="3"/> <apply rule="create-vertex"/> <apply rule="extrude-vertex"/> ... </body>
//
// A rule is applied to all orbits of its hook's kind whose vertices are all selected, in the order of their
// smallest darts; `times` times, the orbits being found again each time. What a rule matches or makes is used
// up for that time. New vertices belong to a group if all vertices that they come from do. A body that would
// grow too large is refused before it does (sim/rules/map_budget.h).
//
// The second hook of a rule that has two (sew-edges, sew-faces) is found by with="touching": the dart at the
// same place, whose side and face lie on those of the first.
//
// A rule that makes volumes on all faces of a sheet (Rule::makes_solids, such as extrude-sheet) makes a solid
// of it.
//
// At the end the cells must be those that a mesh file may hold: closed faces, volumes that are tetrahedra,
// hexahedra, prisms or pyramids. Then darts are ordered as for a file, so that a body does not remember how it
// was made.
#pragma once

#include "sim/base/settings.h"
#include "sim/build/pieces.h"
#include "sim/build/rule_book.h"
#include "sim/build/slit.h"
#include "sim/embedding/selector.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rend {

struct Body;
struct Placement;

struct ApplySettings {
  std::string rule = {}; // its name
  Selector where = {};   // of vertices; none: everywhere
  int times = 1;
  enum class With { Nothing, Touching } with = With::Nothing; // for the second hook of a rule, if it has two
  std::map<std::string, std::string> arguments = {};          // of the rule, by name: expressions of numbers
  SettingsSource source = {};
};
template <> const Fields<ApplySettings>& fields_of();

const ElementType& apply_type();
const ElementType& subdivide_type();
// Of an <apply>, or of a <subdivide>, which is short for the rule that does so in the body's dimension.
ApplySettings read_apply(const PresetNode& node);

// Whether elements still know after slits and pieces of which one they are a part (sim/cuts/start_element.h).
enum class KeepStart { No, Yes };

// Applies rules in their order to the map of the body, cuts slits and pieces, then places and orders it.
// UserError: a rule that applies nowhere, or lets the map grow too large; cells that are none of the standard
// ones; a slit or pieces that cannot be cut.
void construct(Body& body, const std::vector<ApplySettings>& applies, const std::vector<SlitSettings>& slits,
               const std::optional<PiecesSettings>& pieces, const RuleBook& rules, const Placement& place,
               KeepStart keep_start, const SettingsSource& shape);

} // namespace rend
