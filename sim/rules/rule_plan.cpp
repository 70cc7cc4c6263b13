#include "sim/rules/rule_plan.h"

#include "sim/rules/rule_check.h"

#include <algorithm>

namespace rend {
namespace {

using Kind = RuleLink::Kind;

class Planner {
public:
  Planner(const RuleGraph& left, const RuleGraph& right, const std::vector<int>& before,
          const std::vector<int>& after)
      : left_(left), right_(right), before_(before), after_(after), reached_(left.nodes.size()) {}

  RulePlan run() {
    match();
    for (int n = 0; n < left_.size(); ++n)
      for (int i = 0; i < 4; ++i) {
        test(n, i);
        unlink(n, i);
      }
    for (int n = 0; n < left_.size(); ++n)
      if (after_[static_cast<std::size_t>(n)] < 0) plan_.removed.push_back(n);
    for (int n = 0; n < right_.size(); ++n)
      for (int i = 0; i < 4; ++i) link(n, i);
    for (int dimension : {2, 3})
      for (int n = 0; n < right_.size(); ++n)
        plan_.inside[static_cast<std::size_t>(dimension - 2)].push_back(inside(n, dimension));
    plan_.needs_volumes = plan_.links_volumes || needs_neighbour_volumes();
    return std::move(plan_);
  }

private:
  // Of volumes that are there already.
  bool needs_neighbour_volumes() const {
    return std::any_of(left_.nodes.begin(), left_.nodes.end(),
                       [](const RuleNode& node) { return node.links[3].kind == Kind::Arc; });
  }

  void match() {
    std::vector<int> queue;
    for (int n = 0; n < left_.size(); ++n)
      if (left_[n].hook) {
        plan_.hooks.push_back(n);
        queue.push_back(n);
        reached_[static_cast<std::size_t>(n)] = true;
      }
    for (std::size_t at = 0; at < queue.size(); ++at)
      for (int i = 0; i < 4; ++i) {
        const RuleLink& link = left_.link(queue[at], i);
        if (link.kind != Kind::Arc || reached_[static_cast<std::size_t>(link.to)]) continue;
        reached_[static_cast<std::size_t>(link.to)] = true;
        plan_.steps.push_back({link.to, queue[at], i});
        queue.push_back(link.to);
      }
  }

  // Whether a step finds one end of this arc from the other.
  bool is_step(int node, int i) const {
    const int to = left_.link(node, i).to;
    for (const RulePlan::Step& step : plan_.steps)
      if (step.link == i && ((step.node == node && step.from == to) || (step.node == to && step.from == node)))
        return true;
    return false;
  }

  // An implicit link of a node follows from that of the node it was found from, where the two links commute.
  bool follows(int node, int i) const {
    if (node == plan_.hooks[0]) return true; // the walk that makes the instances
    for (const RulePlan::Step& step : plan_.steps) {
      if (step.node != node) continue;
      const bool commute = i - step.link >= 2 || step.link - i >= 2;
      return commute && left_.link(step.from, i) == left_.link(node, i) && follows(step.from, i);
    }
    return false;
  }

  void test(int n, int i) {
    const RuleLink& link = left_.link(n, i);
    if (link.kind == Kind::Absent) return;
    const RulePlan::Test test{n, i, link.kind, link.to};
    if (left_[n].hook && (link.kind == Kind::Loop || link.kind == Kind::Arc)) plan_.first_tests.push_back(test);
    if (link.kind == Kind::Implicit && follows(n, i)) return;
    if (link.kind == Kind::Arc && (link.to < n || is_step(n, i))) return; // an involution: once is enough
    plan_.tests.push_back(test);
  }

  void unlink(int n, int i) {
    const Kind kind = left_.link(n, i).kind;
    const int after = after_[static_cast<std::size_t>(n)];
    if (kind == Kind::Absent || kind == Kind::Loop) return;
    if (after >= 0 && unchanged(left_, n, right_, after, i)) return;
    plan_.unlinks.push_back({n, i});
  }

  // The element of a kept node is divided if one of its links changes.
  bool divides(int right_node, int dimension) const {
    const int before = before_[static_cast<std::size_t>(right_node)];
    for (int i = 0; i < dimension; ++i)
      if (!unchanged(left_, before, right_, right_node, i)) return true;
    return false;
  }

  // The nearest kept node whose element is divided, by arcs.
  int inside(int node, int dimension) const {
    if (before_[static_cast<std::size_t>(node)] >= 0) return -1;
    std::vector<bool> met(right_.nodes.size());
    std::vector<int> queue{node};
    met[static_cast<std::size_t>(node)] = true;
    for (std::size_t at = 0; at < queue.size(); ++at) {
      const int n = queue[at], before = before_[static_cast<std::size_t>(n)];
      if (before >= 0) {
        if (divides(n, dimension)) return before;
        continue; // what lies beyond is another element's
      }
      for (int i = 0; i <= dimension; ++i) {
        const RuleLink& next = right_.link(n, i);
        if (next.kind != Kind::Arc || met[static_cast<std::size_t>(next.to)]) continue;
        met[static_cast<std::size_t>(next.to)] = true;
        queue.push_back(next.to);
      }
    }
    return -1;
  }

  void link(int n, int i) {
    const RuleLink& link = right_.link(n, i);
    const int before = before_[static_cast<std::size_t>(n)];
    if (i == 3 && link.kind == Kind::Arc) plan_.links_volumes = true;
    if (i == 3 && link.kind == Kind::Implicit &&
        left_[plan_.hooks[0]].label[static_cast<std::size_t>(link.to)] != 3)
      plan_.links_volumes = true;
    if (link.kind == Kind::Absent || link.kind == Kind::Loop) return;
    if (before >= 0 && unchanged(left_, before, right_, n, i)) return;
    if (link.kind == Kind::Arc && link.to < n) return; // done from the other end
    plan_.links.push_back({n, i, link.kind, link.to});
  }

  const RuleGraph &left_, &right_;
  const std::vector<int>&before_, &after_;
  std::vector<bool> reached_;
  RulePlan plan_;
};

} // namespace

RulePlan make_plan(const RuleGraph& left, const RuleGraph& right, const std::vector<int>& before,
                   const std::vector<int>& after) {
  return Planner(left, right, before, after).run();
}

} // namespace rend
