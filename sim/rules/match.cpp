#include "sim/rules/match.h"

#include "sim/base/check.h"
#include "sim/topology/index_set.h"

#include <fmt/format.h>

namespace rend {

Hooks::Hooks(std::initializer_list<Dart> darts) {
  CHECK(darts.size() <= darts_.size());
  for (Dart d : darts) darts_[count_++] = d;
}

namespace {

using Kind = RuleLink::Kind;

// A node reached by an arc from an earlier node.
struct Step {
  int node, from, link;
};

struct Plan {
  FixedList<int, 12> hooks; // nodes
  FixedList<Step, 12> steps;
};

Plan plan_of(const RuleGraph& graph) {
  Plan plan;
  std::array<bool, 12> reached{};
  for (int n = 0; n < graph.size(); ++n) {
    if (!graph[n].hook) continue;
    plan.hooks.push_back(n);
    reached[static_cast<std::size_t>(n)] = true;
  }
  for (bool grows = true; grows;) {
    grows = false;
    for (const RuleArc& arc : graph.arcs) {
      const int a = graph.find(arc.from), b = graph.find(arc.to);
      bool &a_reached = reached[static_cast<std::size_t>(a)], &b_reached = reached[static_cast<std::size_t>(b)];
      if (a_reached == b_reached) continue;
      plan.steps.push_back(a_reached ? Step{b, a, arc.link} : Step{a, b, arc.link});
      a_reached = b_reached = grows = true;
    }
  }
  return plan;
}

// Whether a rule would link darts by α3, so that it cannot apply to a sheet.
bool links_by_alpha3(const Rule& rule) {
  for (const RuleArc& arc : rule.right.arcs)
    if (arc.link == 3) return true;
  for (const RuleNode& node : rule.right.nodes)
    if (const int p = node.label.position(3); p >= 0 && rule.positions()[p] != 3) return true;
  return false;
}

class Matcher {
public:
  Matcher(const Rule& rule, const GMap& map, Match& match)
      : rule_(rule), graph_(rule.left), map_(map), match_(match), plan_(plan_of(rule.left)) {}

  std::string run(const Hooks& hooks) {
    match_.nodes = graph_.nodes.size();
    match_.positions = static_cast<std::size_t>(rule_.positions().size);
    match_.darts.clear();
    match_.neighbours.clear();
    match_.instances = 1;
    CHECK_NOTE(hooks.size() == plan_.hooks.size(),
               fmt::format("\"{}\" takes {} hooks", rule_.name, plan_.hooks.size()));
    if (map_.dimension() == 2 && links_by_alpha3(rule_)) return "a sheet has no volumes to link";
    for (Dart d : hooks.span())
      if (!map_.alive(d)) return fmt::format("there is no dart {}", d.value);
    if (match_.nodes > 0) {
      walk_hooks(hooks);
      follow_arcs();
      for (int n = 0; n < graph_.size(); ++n)
        for (int i = 0; i < 4; ++i)
          if (std::string reason = misfit(n, i); !reason.empty()) return reason;
      if (std::string reason = overlap(); !reason.empty()) return reason;
    }
    const char* broken = rule_.precondition ? rule_.precondition(map_, hooks.span()) : nullptr;
    return broken ? broken : "";
  }

private:
  Dart& dart(std::size_t instance, int node) {
    return match_.darts[instance * match_.nodes + static_cast<std::size_t>(node)];
  }

  // The instances: a walk over the orbit of the first hook, and the same walk from all other hooks.
  void walk_hooks(const Hooks& hooks) {
    thread_local IndexMap instance_of;
    instance_of.clear();
    match_.darts.resize(match_.nodes);
    for (std::size_t h = 0; h < plan_.hooks.size(); ++h) dart(0, plan_.hooks[h]) = hooks[h];
    instance_of.insert(hooks[0].value, 0);
    for (std::size_t k = 0; k < match_.instances; ++k) {
      for (int p = 0; p < static_cast<int>(match_.positions); ++p) {
        const auto next = static_cast<std::uint32_t>(match_.instances);
        const Dart d = map_.alpha(rule_.positions()[p], dart(k, plan_.hooks[0]));
        const std::uint32_t found = instance_of.insert(d.value, next);
        match_.neighbours.push_back(found);
        if (found != next) continue;
        ++match_.instances;
        match_.darts.resize(match_.darts.size() + match_.nodes);
        for (int hook : plan_.hooks) dart(next, hook) = map_.alpha(graph_[hook].label[p], dart(k, hook));
      }
    }
  }

  void follow_arcs() {
    if (plan_.steps.size() == 0) return;
    for (std::size_t k = 0; k < match_.instances; ++k)
      for (const Step& step : plan_.steps) dart(k, step.node) = map_.alpha(step.link, dart(k, step.from));
  }

  // How αi of a node differs from the graph; empty if it does not.
  std::string misfit(int node, int i) {
    const RuleLink link = graph_.link(node, i);
    if (link.kind == Kind::Absent || (link.kind == Kind::Implicit && node == plan_.hooks[0])) return {};
    for (std::size_t k = 0; k < match_.instances; ++k) {
      const Dart d = dart(k, node);
      const Dart wanted =
          link.kind == Kind::Implicit ? dart(match_.neighbour(k, link.to), node) : dart(k, link.to);
      const Dart is = map_.alpha(i, d);
      if (is == wanted) continue;
      if (link.kind == Kind::Loop)
        return fmt::format("dart {} should be α{}-free, and is linked to {}", d.value, i, is.value);
      if (link.kind == Kind::Implicit && graph_[node].hook)
        return fmt::format("the orbits of the hooks are not isomorphic: they part at dart {}", d.value);
      return fmt::format("α{} of dart {} should be {}, and is {}", i, d.value, wanted.value, is.value);
    }
    return {};
  }

  std::string overlap() {
    if (match_.nodes == 1) return {}; // the walk visits each dart once
    thread_local IndexSet met;
    met.clear();
    for (Dart d : match_.darts)
      if (!met.insert(d.value)) return fmt::format("dart {} would have to play two parts", d.value);
    return {};
  }

  const Rule& rule_;
  const RuleGraph& graph_;
  const GMap& map_;
  Match& match_;
  Plan plan_;
};

} // namespace

std::string find_match(const Rule& rule, const GMap& map, const Hooks& hooks, Match& match) {
  return Matcher(rule, map, match).run(hooks);
}

} // namespace rend
