// A script, checked: several rules as one change (thesis 3.4.2, p. 86; algorithm 1, chapter 6).
//
//   <script name="delete-face" hook="a*(0,1)">
//     <for each="e*(0)" apply="unsew-edge" at-least="none"/>
//     <for each="e*(0,1)" apply="remove-isolated-face"/>
//   </script>
//
// One rule sees one node per dart of its hook's orbit: what lies around may vary in number, not in shape. A
// script goes over the cells of an orbit, and applies a rule to each: so it divides meshes whose elements are
// of several kinds, and changes a cell whose neighbours are there or not.
//
// Its hook is that of a rule with one node. Its steps follow each other; how they run, and what is a part of
// the hook's orbit after the first of them, is told in script_run.h. Expressions are those of rules
// (rule_values.h), and know two nodes: the hook and the cell.
#pragma once

#include "sim/rules/rule.h"
#include "sim/rules/script_settings.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rend {

struct Script;

// What can be applied by name: a rule or a script; the other one is null.
struct RuleOrScript {
  std::shared_ptr<const Rule> rule;
  std::shared_ptr<const Script> script;

  RuleOrScript(std::shared_ptr<const Rule> rule_) : rule(std::move(rule_)) {}
  RuleOrScript(std::shared_ptr<const Script> script_) : script(std::move(script_)) {}

  const char* kind() const { return rule ? "rule" : "script"; }
  const std::string& name() const;
  const std::string& about() const;
  std::size_t hooks() const; // how many
  Orbit hook_orbit() const;  // of the first one
  const std::vector<Rule::Where>& wheres() const;
  std::vector<std::string> quantities_of_law() const; // of Rule
  bool fits_sheets() const;                           // false: it can never apply to one
  bool grows() const;                                 // it may create darts or links, or move vertices
  std::string print() const;
};

struct Script {
  // What a step names; throws UserError where there is no such rule or script.
  using Find = std::function<RuleOrScript(const ScriptStepSettings&)>;
  // UserError (65) with the place of the attribute: all that `rend rule check` refuses.
  Script(ScriptSettings settings, const Find& find);

  // Of what a step applies.
  struct Argument {
    std::size_t number; // of the argument
    Expression value;   // of the step's scope
    bool varies;        // from cell to cell
  };
  struct Step {
    std::optional<Orbit> cell; // none: once
    RuleOrScript what;
    // Changes nothing: its nodes are the hook and the cell, as single darts, those that there are; its
    // condition is the test, and its arguments are those of the script.
    Rule scope;
    std::vector<Argument> arguments;
  };

  const std::string& name() const { return settings.name; }
  bool has_hook() const { return !scope.left.nodes.empty(); }
  Orbit hook_orbit() const { return scope.hook_orbit(); } // of one that has a hook
  std::vector<std::string> quantities_of_law() const;     // of its expressions and of what it applies
  bool fits_sheets() const;                               // every step does
  bool grows() const;
  // As the element <script> of a preset, in a normal form: read, it makes the same script.
  std::string print() const;

  void check_marks() const;

  static constexpr int deepest = 20;            // scripts that apply each other
  static constexpr std::size_t largest = 10000; // scripts that are applied, each as often as steps name it

  ScriptSettings settings;
  Rule scope; // changes nothing: its node is the hook, with the script's conditions and arguments
  std::vector<Step> steps;
  int depth = 1;        // of the scripts that it applies, and itself
  std::size_t size = 1; // how many they are, itself included
};

} // namespace rend
