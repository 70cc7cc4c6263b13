// Applying a rule or a script everywhere in a map: to all orbits of its hook's kind, in the order of their
// smallest darts.
//
// One round visits each orbit once. What an application has matched or made is used up for the rest of the
// round, so that the order of orbits decides where matches overlap, and a round ends. All applications of a
// round share one edit, and their expressions read the points from before it. A script uses up what its rules
// have matched or made; it may match what is used up, but for its hook's orbit.
//
// A place is an orbit of the hook's kind that is selected. It is *skipped* where the rule matches, but would
// touch what is used up: the next round applies it there, if it still matches. Of a script that is not known,
// and all selected orbits with something used up are skipped.
//
// Before a round of a rule its darts are counted: the places where the rule matches, times the darts that it
// adds at each. If the map would have more than the context's most_darts, the round is not begun. What a script
// will add is not known before; there every application of a rule is asked, and the round is taken back.
#pragma once

#include "sim/rules/script_run.h"

#include <functional>

namespace rend {

struct RoundResult {
  std::size_t applied = 0;
  std::size_t skipped = 0; // places
  std::size_t refused = 0; // places where it does not apply
  std::string reason;      // of the first refusal; empty: none

  // The map would have too many darts, and is as before.
  bool over_budget = false;
  std::size_t places = 0, darts = 0; // then, if they were counted: of the round, of the map after it
};

// The darts to try for the second hook, beside a first one.
using Partners = std::function<std::vector<Dart>(Dart)>;

// Which orbits: those all of whose darts are `selected`; empty: all. It is asked for darts of the map as it is
// when the round begins. `partners`, for rules with two hooks: the darts to try for the second one; it must be
// given for them, and the rule is applied with the first that matches. Other numbers of hooks: CHECK.
RoundResult apply_round(EmbeddedMap& map, RuleOrScriptRunner& runner,
                        const std::function<bool(Dart)>& selected = {}, const Partners& partners = {});

} // namespace rend
