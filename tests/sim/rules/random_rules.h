// Random rules that are legal: house rules with labels, nodes, arcs and free links changed at random, of
// which those are kept that the checker accepts.
#pragma once

#include "sim/base/error.h"
#include "sim/house_rules/house_rules.h"
#include "sim/rules/rule_check.h"
#include "sim/rules/rule_vertices.h"

#include <optional>
#include <random>
#include <string>
#include <vector>

namespace rend::random_rules {

// A graph that may be illegal; links are changed at one end at a time.
struct Draft {
  struct Arc {
    std::string from;
    int i;
    std::string to; // empty: a free link
  };
  std::vector<RuleNode> nodes; // names, labels and stars alone
  std::vector<Arc> arcs;

  explicit Draft(const RuleGraph& graph) : nodes(graph.nodes) {
    for (int n = 0; n < graph.size(); ++n)
      for (int i = 0; i < 4; ++i) {
        const RuleLink& link = graph.link(n, i);
        if (link.kind == RuleLink::Kind::Arc && link.to > n)
          arcs.push_back({graph[n].name, i, graph[link.to].name});
        if (link.kind == RuleLink::Kind::Loop) arcs.push_back({graph[n].name, i, ""});
      }
  }

  std::string text() const {
    std::string out;
    for (const RuleNode& node : nodes) {
      out += " " + node.name + (node.hook ? "*" : "");
      for (std::size_t p = 0; p < node.label.size(); ++p)
        out += (p == 0 ? "(" : ",") + (node.label[p] < 0 ? "_" : std::to_string(node.label[p]));
      if (!node.label.empty()) out += ")";
    }
    for (const Arc& arc : arcs)
      out += arc.to.empty() ? " " + arc.from + "|" + std::to_string(arc.i)
                            : " " + arc.from + "-" + std::to_string(arc.i) + "-" + arc.to;
    return out;
  }
};

class Generator {
public:
  explicit Generator(unsigned seed) : random_(seed) {}

  // The next one that is accepted. Counts those that are refused in `refused`.
  Rule next() {
    for (;; ++refused) {
      if (std::optional<Rule> rule = attempt()) return std::move(*rule);
    }
  }
  std::size_t refused = 0;

private:
  int below(std::size_t n) { return static_cast<int>(random_() % n); }
  template <class T> T& one_of(std::vector<T>& all) { return all[static_cast<std::size_t>(below(all.size()))]; }

  std::optional<Rule> attempt() {
    const Rule& house = house_rules()[static_cast<std::size_t>(below(house_rules().size()))];
    Draft left(house.left), right(house.right);
    for (int n = below(4); n >= 0; --n) change(left, right);
    RuleSettings settings{.name = "random", .left = left.text(), .right = right.text()};
    settings.may_fold = house.settings.may_fold ? below(4) > 0 : below(20) == 0;
    try {
      const RuleGraph before = RuleGraph::parse(RuleSide::Left, settings.left),
                      after = RuleGraph::parse(RuleSide::Right, settings.right);
      check_graphs(before, after, settings.may_fold);
      place_vertices(settings, before, after);
      return Rule(settings);
    } catch (const RuleFault&) {
      return std::nullopt;
    } catch (const UserError&) { // a value that is not the same at all darts of its vertex
      return std::nullopt;
    }
  }

  void change(Draft& left, Draft& right) {
    switch (below(10)) {
    case 0:
      return reverse(left, right);
    case 1:
      return drop_position(left, right);
    case 2:
      return add_position(left, right);
    case 3:
      return drop_node(left, right);
    case 4:
      return add_node(left, right);
    default:
      break;
    }
    Draft& one = below(2) == 0 ? left : right;
    switch (below(4)) {
    case 0:
      return rename(one);
    case 1:
      return change_link(one);
    case 2:
      return add_link(one);
    default:
      if (!one.arcs.empty()) one.arcs.erase(one.arcs.begin() + below(one.arcs.size()));
    }
  }

  // α0 .. α3 become α3 .. α0, which keeps what commutes.
  static void reverse(Draft& left, Draft& right) {
    for (Draft* each : {&left, &right}) {
      for (RuleNode& node : each->nodes)
        for (int& link : node.label)
          if (link >= 0) link = 3 - link;
      for (Draft::Arc& arc : each->arcs) arc.i = 3 - arc.i;
    }
  }

  void drop_position(Draft& left, Draft& right) {
    if (left.nodes.empty() || left.nodes[0].label.empty()) return;
    const int p = below(left.nodes[0].label.size());
    for (Draft* each : {&left, &right})
      for (RuleNode& node : each->nodes)
        if (p < static_cast<int>(node.label.size())) node.label.erase(node.label.begin() + p);
  }

  // In place of free links, where there are some.
  void add_position(Draft& left, Draft& right) {
    if (left.nodes.empty() || left.nodes[0].label.size() > 3) return;
    const int link = below(4);
    for (Draft* each : {&left, &right}) {
      for (RuleNode& node : each->nodes) node.label.push_back(below(8) > 0 ? link : below(5) - 1);
      std::erase_if(each->arcs, [&](const Draft::Arc& arc) { return arc.i == link && arc.to.empty(); });
    }
  }

  void drop_node(Draft& left, Draft& right) {
    Draft& one = below(2) == 0 ? left : right;
    if (one.nodes.empty()) return;
    const std::string name = one_of(one.nodes).name;
    for (Draft* each : {&left, &right}) {
      if (each != &one && below(2) == 0) continue;
      std::erase_if(each->nodes, [&](const RuleNode& node) { return node.name == name; });
      for (Draft::Arc& arc : each->arcs) {
        if (arc.from == name) std::swap(arc.from, arc.to);
        if (arc.to == name) arc.to.clear();
      }
      std::erase_if(each->arcs, [&](const Draft::Arc& arc) { return arc.from.empty() || arc.from == name; });
    }
  }

  // A copy of a node, joined to it where both were free, or nowhere.
  void add_node(Draft& left, Draft& right) {
    Draft& one = below(3) == 0 ? left : right;
    if (one.nodes.empty()) return;
    const RuleNode model = one_of(one.nodes);
    const std::string name = "new_" + std::to_string(++names_);
    const bool both = &one == &left && below(2) == 0;
    const int joined = below(6);
    for (Draft* each : {&left, &right}) {
      if (each != &one && !both) continue;
      RuleNode node = model;
      node.name = name;
      node.hook = each == &left && model.hook && joined > 3;
      each->nodes.push_back(node);
      std::vector<Draft::Arc> added;
      for (Draft::Arc& arc : each->arcs) {
        if (arc.from != model.name || !arc.to.empty()) continue;
        if (arc.i == joined)
          arc.to = name;
        else
          added.push_back({name, arc.i, ""});
      }
      each->arcs.insert(each->arcs.end(), added.begin(), added.end());
    }
  }

  void rename(Draft& draft) {
    if (draft.nodes.empty()) return;
    RuleNode& node = one_of(draft.nodes);
    if (!node.label.empty()) one_of(node.label) = below(5) - 1;
  }

  void change_link(Draft& draft) {
    if (draft.arcs.empty()) return;
    Draft::Arc& arc = one_of(draft.arcs);
    const Draft::Arc was = arc;
    switch (below(3)) {
    case 0:
      arc.i = below(4);
      return;
    case 1:
      arc.to = one_of(draft.nodes).name;
      return;
    default: // an arc becomes two free links
      if (was.to.empty()) return;
      arc.to.clear();
      draft.arcs.push_back({was.to, was.i, ""});
    }
  }

  void add_link(Draft& draft) {
    if (draft.nodes.empty()) return;
    draft.arcs.push_back({one_of(draft.nodes).name, below(4), below(2) == 0 ? "" : one_of(draft.nodes).name});
  }

  // Of new vertices always, of others now and then.
  void place_vertices(RuleSettings& settings, const RuleGraph& left, const RuleGraph& right) {
    std::vector<bool> placed(right.nodes.size());
    std::vector<int> before;
    for (const RuleNode& node : right.nodes) before.push_back(left.find(node.name));
    const VertexJoins joins(left, right, before);
    for (int n = 0; n < right.size(); ++n) {
      if (placed[static_cast<std::size_t>(n)]) continue;
      const std::vector<bool> vertex = right.reach(n, Vertex);
      bool kept = false;
      for (int m = 0; m < right.size(); ++m) {
        if (!vertex[static_cast<std::size_t>(m)]) continue;
        placed[static_cast<std::size_t>(m)] = true;
        kept = kept || left.find(right[m].name) >= 0;
      }
      if (kept && !joins.at(n) && below(6) > 0) continue;
      RuleSetSettings set{.node = right[n].name, .position = expression(left, 0)};
      if (below(8) == 0) set.rest = expression(left, 0);
      if (below(8) == 0) set.velocity = expression(left, 0);
      settings.sets.push_back(set);
    }
  }

  std::string expression(const RuleGraph& left, int depth) {
    if (left.nodes.empty())
      return "point(" + std::to_string(below(5)) + ", " + std::to_string(below(5)) + ", " +
             std::to_string(below(5)) + ")";
    const std::string node = left[below(left.nodes.size())].name;
    static constexpr const char* orbits[] = {"vertex", "edge", "face", "volume", "component"};
    static constexpr const char* directions[] = {"normal", "face", "edge"};
    const std::string mean = "mean(" + node + ", " + orbits[below(5)] + ")";
    switch (below(depth > 2 ? 3 : 8)) {
    case 0:
      return node;
    case 1:
    case 2:
      return mean;
    case 3:
      return "along(" + node + ", " + directions[below(3)] + ", 0.25)";
    case 4:
      return "lerp(" + expression(left, depth + 1) + ", " + expression(left, depth + 1) + ", 0.3)";
    case 5:
      return mean + " + point(0, 0, size(" + node + ", " + orbits[below(5)] + ") / 100)";
    case 6:
      return "(" + expression(left, depth + 1) + " + " + expression(left, depth + 1) + ") / 2";
    default:
      return "mean(" + node + ", component) * (1 + length(" + node + ") / 100)";
    }
  }

  std::mt19937 random_;
  int names_ = 0;
};

} // namespace rend::random_rules
