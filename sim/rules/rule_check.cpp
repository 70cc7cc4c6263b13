#include "sim/rules/rule_check.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {

using Kind = RuleLink::Kind;

bool unchanged(const RuleGraph& left, int left_node, const RuleGraph& right, int right_node, int i) {
  const RuleLink before = left.link(left_node, i), after = right.link(right_node, i);
  if (before.kind != after.kind) return false;
  if (before.kind != Kind::Arc) return before.kind != Kind::Implicit || before.to == after.to;
  return left[before.to].name == right[after.to].name;
}

namespace {

class Checker {
public:
  Checker(const RuleGraph& left, const RuleGraph& right) : left_(left), right_(right) {
    for (const RuleNode& node : left_.nodes)
      if (node.hook && !hook_) hook_ = &node;
  }

  void run(bool may_fold) const {
    hooks();
    labels(RuleSide::Left);
    labels(RuleSide::Right);
    for (int n = 0; n < left_.size(); ++n) kept_or_removed(n);
    for (int n = 0; n < right_.size(); ++n) kept_or_created(n);
    for (int n = 0; n < right_.size(); ++n)
      for (int i = 0; i < 4; ++i)
        for (int j = i + 2; j < 4; ++j) cycle(n, i, j);
    if (may_fold) unlinks_only();
  }

private:
  const RuleGraph& graph(RuleSide side) const { return side == RuleSide::Left ? left_ : right_; }

  [[noreturn]] void fail(RuleSide side, const RuleNode& node, const std::string& what,
                         const std::string& hint = {}) const {
    throw RuleFault(side, node.column, what, hint);
  }

  void hooks() const {
    for (const RuleNode& node : right_.nodes)
      if (node.hook)
        fail(RuleSide::Right, node, fmt::format("node {} of the right graph has a star", node.name),
             "hooks are where a match begins: the left graph alone has them");
    for (int n = 0; n < left_.size(); ++n) {
      const std::vector<bool> part = left_.reach(n, Orbit{0, 1, 2, 3});
      int count = 0;
      for (int m = 0; m < left_.size(); ++m) count += part[static_cast<std::size_t>(m)] && left_[m].hook;
      if (count == 0)
        fail(RuleSide::Left, left_[n], fmt::format("no hook leads to node {}", left_[n].name),
             "each connected part of the left graph has one node with a star");
      if (count > 1)
        fail(RuleSide::Left, left_[n], fmt::format("two hooks lead to node {}", left_[n].name),
             "each connected part of the left graph has one node with a star");
    }
  }

  void labels(RuleSide side) const {
    const std::size_t length = hook_ ? hook_->label.size() : 0;
    for (const RuleNode& node : graph(side).nodes) {
      if (!hook_ && !node.label.empty())
        fail(side, node,
             fmt::format("node {} has a label, and there is no hook whose links it could name", node.name),
             "a rule with left=\"\" creates single darts, whose links are all arcs and free links");
      if (node.label.size() != length)
        fail(side, node,
             fmt::format("the label of node {} has {} links, and that of hook {} has {}", node.name,
                         node.label.size(), hook_->name, length),
             "position k of a label tells what the hook's k-th link becomes; _ where it is dropped");
      if (node.hook && node.position(RuleNode::dropped) >= 0)
        fail(side, node, fmt::format("the label of hook {} drops a link", node.name),
             "a hook stands for a whole orbit: leave that link out of all labels");
    }
  }

  void kept_or_removed(int n) const {
    const RuleNode& node = left_[n];
    const int after = right_.find(node.name);
    for (int i = 0; i < 4; ++i) {
      const bool had = left_.link(n, i).kind != Kind::Absent;
      if (after < 0 && !had)
        fail(RuleSide::Left, node,
             fmt::format("node {} is removed, but what its α{} leads to is not matched", node.name, i),
             fmt::format("match it: an arc {}-{}-..., a free link {}|{}, or in the label", node.name, i,
                         node.name, i));
      if (after >= 0 && had && right_.link(after, i).kind == Kind::Absent)
        fail(RuleSide::Right, right_[after], fmt::format("node {} is kept but loses α{}", node.name, i),
             fmt::format("the right graph says what becomes of it, such as {}|{}", node.name, i));
    }
  }

  void kept_or_created(int n) const {
    const RuleNode& node = right_[n];
    const int before = left_.find(node.name);
    for (int i = 0; i < 4; ++i) {
      const bool has = right_.link(n, i).kind != Kind::Absent;
      if (before < 0 && !has)
        fail(RuleSide::Right, node, fmt::format("the new node {} does not say what its α{} is", node.name, i),
             fmt::format("free, {}|{}; an arc, {}-{}-...; or in the label", node.name, i, node.name, i));
      if (before >= 0 && has && left_.link(before, i).kind == Kind::Absent)
        fail(RuleSide::Right, node, fmt::format("node {} is kept but gains α{}", node.name, i),
             fmt::format("the left graph must match what it was, such as {}|{}", node.name, i));
    }
  }

  // Whether αiαj is an involution at a node of the right graph whose αi or αj is new.
  bool closes(int n, int i, int j) const {
    const RuleLink by_i = right_.link(n, i), by_j = right_.link(n, j);
    if (by_i.kind == Kind::Absent || by_j.kind == Kind::Absent) return false; // the far side is unknown
    if (by_i.kind == Kind::Implicit && by_j.kind == Kind::Implicit) {
      const int p = hook_->label[static_cast<std::size_t>(by_i.to)],
                q = hook_->label[static_cast<std::size_t>(by_j.to)];
      return p - q >= 2 || q - p >= 2;
    }
    if (by_i.kind == Kind::Implicit) return right_.link(by_j.to, i) == by_i;
    if (by_j.kind == Kind::Implicit) return right_.link(by_i.to, j) == by_j;
    const RuleLink around_i = right_.link(by_i.to, j), around_j = right_.link(by_j.to, i);
    const auto explicit_ = [](const RuleLink& link) {
      return link.kind == Kind::Arc || link.kind == Kind::Loop;
    };
    return explicit_(around_i) && explicit_(around_j) && around_i.to == around_j.to;
  }

  void cycle(int n, int i, int j) const {
    const RuleNode& node = right_[n];
    const int before = left_.find(node.name);
    if (before >= 0 && unchanged(left_, before, right_, n, i) && unchanged(left_, before, right_, n, j)) return;
    if (closes(n, i, j)) return;
    fail(RuleSide::Right, node, fmt::format("at node {}, α{}α{} is no involution any more", node.name, i, j),
         fmt::format("following α{}, α{}, α{}, α{} from {} must lead back to it{}", i, j, i, j, node.name,
                     what_would_close(n, i, j)));
  }

  // What has to be there, given one of the two links; empty: the left graph does not mention the other one.
  std::string what_would_close(int n, int i, int j) const {
    const RuleLink by_i = right_.link(n, i), by_j = right_.link(n, j);
    if (by_i.kind == Kind::Absent || by_j.kind == Kind::Absent)
      return fmt::format(": mention α{} of {} in both graphs", by_i.kind == Kind::Absent ? i : j,
                         right_[n].name);
    if (by_i.kind == Kind::Implicit && by_j.kind == Kind::Implicit)
      return fmt::format(
          ": they stand where the hook has α{} and α{}, which do not fit; 0 fits to 2 and 3, 1 to 3",
          hook_->label[static_cast<std::size_t>(by_i.to)], hook_->label[static_cast<std::size_t>(by_j.to)]);
    if (by_i.kind == Kind::Implicit || by_j.kind == Kind::Implicit) {
      const bool first = by_i.kind == Kind::Implicit;
      return fmt::format(": {} must have {} at place {} of its label, as {} has",
                         right_[first ? by_j.to : by_i.to].name, first ? i : j, (first ? by_i.to : by_j.to) + 1,
                         right_[n].name);
    }
    if (by_i.kind == Kind::Loop || by_j.kind == Kind::Loop)
      return fmt::format(": {0}|{1} fits to {2}|{1}", right_[by_i.kind == Kind::Loop ? by_j.to : by_i.to].name,
                         by_i.kind == Kind::Loop ? i : j, right_[n].name);
    return fmt::format(": {0}-{1}-x and {2}-{3}-x must lead to the same node x", right_[by_i.to].name, j,
                       right_[by_j.to].name, i);
  }

  void unlinks_only() const {
    const char* hint = "may-fold lets darts coincide, which is safe where links are only opened";
    for (const RuleNode& node : right_.nodes) {
      const int before = left_.find(node.name);
      if (before < 0)
        fail(RuleSide::Right, node, fmt::format("node {} is created by a rule that may fold", node.name), hint);
      for (int i = 0; i < 4; ++i) {
        const int after = right_.find(node.name);
        if (!unchanged(left_, before, right_, after, i) && right_.link(after, i).kind != Kind::Loop)
          fail(RuleSide::Right, node,
               fmt::format("α{} of node {} is linked by a rule that may fold", i, node.name), hint);
      }
    }
    for (const RuleNode& node : left_.nodes)
      if (right_.find(node.name) < 0)
        fail(RuleSide::Left, node, fmt::format("node {} is removed by a rule that may fold", node.name), hint);
  }

  const RuleGraph &left_, &right_;
  const RuleNode* hook_ = nullptr; // the first; null: the rule only creates
};

} // namespace

void check_graphs(const RuleGraph& left, const RuleGraph& right, bool may_fold) {
  Checker(left, right).run(may_fold);
}

} // namespace rend
