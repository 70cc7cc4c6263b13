// Applying a script: its steps one after another, as one change (thesis 3.4.2, algorithm 1 of chapter 6).
//
// *Of the hook* are all darts of its orbit when the script begins. After each step also those are that the
// hook's links lead to from them, and those that an application has created whose matched darts were all of the
// hook. So the parts of a cell that was divided or cut apart are all of the hook.
//
// A step finds its cells, the orbits of that kind that hold a dart of the hook, asks its test of each, and
// evaluates its arguments, before it changes anything; it visits them in the order of a walk from the hook's
// dart. There it applies its rule. If the rule's hook stands for a part of the cell, it is tried from one
// dart after another until it applies, as a law does (sim/fracture/rule_change.h); if it has two hooks, with
// any two darts. A cell whose darts are all gone is passed by.
//
// Expressions of a step read points as the step before has left them, and know the marks that steps before it,
// and it itself at earlier cells, have set.
//
// A script applies as a whole or not at all: where a step does not apply as often as it must, where no step
// applies anywhere, and where the map would grow beyond its budget, the edit is rolled back to where the script
// began, and the reason is kept.
#pragma once

#include "sim/rules/apply.h"
#include "sim/rules/script.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace rend {

class RuleOrScriptRunner;

// Why a rule or a script did not apply, in words that name no dart, so that refusals can be counted.
struct Refusal {
  int stage = 0; // how far it came; 0: there was none
  std::string reason = {};
};

// Applies one script many times, and keeps its buffers.
class ScriptRunner {
public:
  explicit ScriptRunner(const Script& script, RuleContext context = {});
  ScriptRunner(ScriptRunner&&) noexcept;
  ~ScriptRunner();

  const Script& script() const { return script_; }
  RuleContext& context() { return context_; }

  // False: the edit is as before. CHECK: a hook if the script has one, none if it has none.
  bool apply(Edit& edit, const Hooks& hooks);

  const std::string& reason() const { return reason_; } // why the last call returned false; empty: it did not
  const Refusal& refusal() const { return refusal_; }   // the same
  bool over_budget() const { return over_budget_; }     // that was why
  // After apply(): darts that its rules have matched, and those that they have left in their place.
  const std::vector<Dart>& used() const { return used_; }

private:
  struct Step;
  bool begin(Edit& edit, const Hooks& hooks);
  bool run(Edit& edit, Step& step);
  void find_cells(const Edit& edit, Step& step);
  bool is_chosen(const Edit& edit, Step& step, std::span<const Dart> cell) const;
  bool look(const Edit& edit, Step& step, Dart cell) const;
  void choose(const Edit& edit, Step& step, std::span<const Dart> cell);
  bool apply_at(Edit& edit, Step& step, std::size_t cell);
  bool refuse_growth(const Step& step); // false
  void note(Step& step);
  void mark(Step& step);
  void settle(Edit& edit);
  void grow(const Edit& edit);

  const Script& script_;
  RuleContext context_;
  RuleRunner scope_;
  std::vector<std::unique_ptr<Step>> steps_;

  // Of the call that runs.
  RuleMarks marks_;
  Dart hook_;                                 // where it was removed: the first dart left of the hook
  std::vector<Dart> of_;                      // of the hook, in the order of a walk
  IndexSet is_of_;                            // the same
  std::vector<Dart> added_;                   // created by applications within them
  IndexSet made_;                             // created by the script
  std::size_t created_before_ = 0;            // length of the journal's list
  std::vector<Dart> cells_;                   // of a step, cell by cell
  std::vector<std::size_t> first_;            // of each cell in cells_, and the end
  std::vector<Value> values_;                 // of the arguments, cell by cell
  std::vector<Dart> left_;                    // scratch: the darts of one cell that still exist
  std::vector<std::pair<Dart, Point>> moved_; // by the step
  std::size_t applied_ = 0;
  std::vector<Dart> used_, matched_; // matched_: without those left in their place
  std::string reason_;
  Refusal refusal_;
  bool over_budget_ = false;
};

// A runner of either.
class RuleOrScriptRunner {
public:
  explicit RuleOrScriptRunner(const RuleOrScript& what, RuleContext context = {});

  std::size_t hooks() const { return hooks_; }
  Orbit hook_orbit() const { return hook_; } // of the first
  RuleContext& context() { return rule_ ? rule_->context() : script_->context(); }
  bool apply(Edit& edit, const Hooks& hooks) {
    const bool done = rule_ ? rule_->apply(edit, hooks) : script_->apply(edit, hooks);
    over_budget_ = !done && (rule_ ? rule_->over_budget() : script_->over_budget());
    return done;
  }
  // At one dart after another, one for each orbit of its hook, until it applies, or the map would grow too
  // large; with two hooks, at one pair after another. `furthest`, if given, becomes the refusal that came
  // furthest, or stays if that is it. `fault`, for one hook, is asked wherever it has applied: if it gives a
  // reason, that is taken back.
  bool apply_at_first(Edit& edit, std::span<const Dart> darts, Refusal* furthest = nullptr,
                      const std::function<std::string()>& fault = {});
  static constexpr const char* unfit = "it would make an element flat or inside out";
  std::string sentence() const; // why the last call returned false
  Refusal refusal() const;      // the same
  // It was because the map would have had more than the most darts of the context.
  bool over_budget() const { return over_budget_; }

  RuleRunner* rule() { return rule_.get(); }       // null: it is a script
  ScriptRunner* script() { return script_.get(); } // null: it is a rule

private:
  void keep_furthest(Refusal& furthest) const;

  std::size_t hooks_; // how many
  Orbit hook_;        // of the first
  bool over_budget_ = false;
  std::unique_ptr<RuleRunner> rule_;
  std::unique_ptr<ScriptRunner> script_;
  std::vector<Dart> orbit_;
  IndexSet tried_;
};

} // namespace rend
