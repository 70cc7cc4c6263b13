// Small maps on which a rule is shown, made by the rules of the house.
#pragma once

#include "sim/rules/apply.h"

#include <memory>
#include <string>
#include <vector>

namespace rend {

struct SampleMap {
  std::string name, what; // "sheet", "2 x 2 quads"
  std::unique_ptr<EmbeddedMap> (*make)();
  bool apart = false; // it waits for being sewn
};

// Simple ones first.
const std::vector<SampleMap>& sample_maps();

// The one of that name, all if it is empty. UserError (Usage): there is none.
std::vector<const SampleMap*> samples_called(const std::string& name);

// A sample before and after a rule.
struct RuleShown {
  const SampleMap* sample = nullptr; // null: the rule applies to none of them
  std::unique_ptr<EmbeddedMap> before, after;
  std::vector<Dart> hooks; // in `before`
};

// On the sample of that name, or, if it is empty, on the first one where the rule applies: those of three
// dimensions come first for a rule that speaks of α3, and those that can be sewn for one that sews. Of
// several hooks those next to each other are taken. Results without faces of fewer than three sides are
// preferred. UserError (Usage): no such sample.
RuleShown show(const Rule& rule, const std::string& sample = {});

} // namespace rend
