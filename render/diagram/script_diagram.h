// A script as a drawing, as fig. 3.49 of the thesis shows one: its steps in words, and a small map before it
// and after each of them.
//
// Of what a law would tell, the plane that would split a vertex is taken across x; stress, strain and the value
// of a criterion are not known.
#pragma once

#include "render/diagram/drawing.h"
#include "render/diagram/sample_maps.h"
#include "sim/rules/script.h"

#include <memory>
#include <string>
#include <vector>

namespace rend {

// A sample before a script, and after each of its steps; of one with many steps, before and after.
struct ScriptShown {
  const SampleMap* sample = nullptr; // null: the script applies to none of them
  std::vector<std::unique_ptr<EmbeddedMap>> stages;
  std::vector<Dart> hook; // in the first one
};

// On the sample of that name, or, if it is empty, on the first one where the script applies, those of its
// dimension first; there, where it changes most. UserError (Usage): no such sample.
ScriptShown show(const Script& script, const std::string& sample = {});

Drawing diagram_of(const Script& script, const ScriptShown& shown);

// "1. at each side of a face e*(0): unsew-edge, where it applies"
std::string step_in_words(const Script& script, std::size_t step);

} // namespace rend
