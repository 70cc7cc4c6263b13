// A script as it is written: in a preset, in a file of rules, or in a program.
//
//   <script name="delete-face" about="a face lets go of its neighbours and is gone" hook="a*(0,1)">
//     <for each="e*(0)" apply="unsew-edge" at-least="none"/>
//     <for each="e*(0,1)" apply="remove-isolated-face"/>
//   </script>
//
// <when> and <where> are those of rules (rule_settings.h).
#pragma once

#include "sim/rules/rule_settings.h"

#include <map>
#include <string>
#include <vector>

namespace rend {

// One step: for each cell of the hook's orbit where a test holds, a rule or another script is applied.
struct ScriptStepSettings {
  std::string each = {}; // e*(0,2): a name and an orbit; empty: once, for what takes no hook
  std::string test = {}; // an expression; empty: everywhere
  RuleWhenSettings::At at = RuleWhenSettings::At::Hook; // where the test must hold
  std::string apply = {};                               // the name of a rule or a script
  // Cells that have darts from before the script, cells that it has made, or all of them.
  enum class Which { All, Old, New } which = Which::All;
  // At how many of the chosen cells it must apply, or else the script is taken back.
  enum class AtLeast { All, One, None } at_least = AtLeast::All;
  std::string mark = {}; // that the darts get which it has matched or made (rule_marks.h); empty: none
  std::map<std::string, std::string> arguments = {}; // of what is applied, by name: expressions
  SettingsSource source = {};
};
template <> const Fields<ScriptStepSettings>& fields_of();

struct ScriptSettings {
  std::string name = {};
  std::string about = {};
  std::string hook = {}; // a*(0,1,2), as in the left graph of a rule; empty: it creates out of nothing
  std::vector<ScriptStepSettings> steps = {};
  std::vector<RuleWhenSettings> whens = {};
  std::vector<RuleWhereSettings> wheres = {};
  SettingsSource source = {};
};
template <> const Fields<ScriptSettings>& fields_of();

} // namespace rend
