// Applying a rule: find a match of its left graph and replace it by the right graph.
//
//   if (const Applied done = apply(rule("unsew-edge"), body, dart); !done.ok) report(done.reason);
//
// If there is no match, a condition does not hold, an expression has no finite value, a new element would be
// flat or inverted, or the map would grow beyond its budget, the map is unchanged to the last byte, and the
// reason is returned. A checked rule preserves the axioms wherever it matches. Rules give vertices their
// points; all other embeddings follow by their own policies (column.h).
#pragma once

#include "sim/rules/rule_values.h"

#include <string>
#include <vector>

namespace rend {

// Applies one rule many times, within one open edit or in several, and keeps its buffers.
class RuleRunner {
public:
  explicit RuleRunner(const Rule& rule, RuleContext context = {}) : rule_(rule), context_(std::move(context)) {}

  const Rule& rule() const { return rule_; }
  RuleContext& context() { return context_; }
  const RuleContext& context() const { return context_; }

  // Whether the links that it asks of a hook itself are free there, or are not.
  bool may_begin(const Edit& edit, int hook, Dart d) const;
  // Whether it matches there and its conditions hold. Changes nothing.
  bool matches(const Edit& edit, const Hooks& hooks);
  // Rewrites what matches() has found; false: the map is as before.
  bool rewrite(Edit& edit);
  // Both; false: the map is as before. Expressions read the points from before the edit, and those
  // given to its new darts. CHECK: as many hooks as the rule requires.
  bool apply(Edit& edit, const Hooks& hooks);

  const Mismatch& mismatch() const { return mismatch_; } // of the last call
  bool over_budget() const { return mismatch_.kind == Mismatch::Kind::Budget; }
  std::string reason() const; // a sentence; empty: it was applied
  // After apply(): [instance][node of the right graph].
  const std::vector<Dart>& darts() const { return darts_; }
  const Match& match() const { return match_; }
  // After apply(): vertices that were there before it, a dart of each, and where they moved.
  const std::vector<std::pair<Dart, Point>>& moved() const { return moved_; }

private:
  bool fits(const Edit& edit) const;

  const Rule& rule_;
  RuleContext context_;
  Match match_;
  Mismatch mismatch_;
  std::vector<Dart> darts_;
  std::vector<std::uint32_t> point_; // of the edit, [instance][node of the right graph]
  std::vector<std::pair<Dart, Point>> moved_;
};

struct Applied {
  bool ok = false;
  std::string reason; // a sentence; empty if ok

  // The darts of a node of the right graph, one per instance; the first belongs to the hook itself.
  // CHECK: the rule has such a node.
  std::vector<Dart> darts(std::string_view node) const;
  Dart dart(std::string_view node) const { return darts(node).front(); }

  const Rule* rule = nullptr;
  std::vector<Dart> all; // [instance][node of the right graph]
};

// The arguments of a rule that differ from their defaults, by name. CHECK: the rule has them.
using RuleArguments = std::vector<std::pair<std::string, Value>>;
RuleContext context_of(const Rule& rule, const RuleArguments& arguments);

// Once, within an open edit.
Applied apply(const Rule& rule, Edit& edit, const Hooks& hooks = {}, const RuleArguments& arguments = {});

// In an edit of its own.
Applied apply(const Rule& rule, EmbeddedMap& body, const Hooks& hooks = {},
              const RuleArguments& arguments = {});

} // namespace rend
