// Whether a rule preserves the axioms of the map, decided at compile time (thesis 3.4.1.1; Poudret 2009).
//
//   static_assert(well_formed(unsew_edge));
//
// 1. Incident arcs: a created dart has each of its four links once; a kept dart has the links it had on the
//    left, none gained and none lost; a removed dart has all four on the left, so that nothing is left hanging.
// 2. Cycles: for j ≥ i+2, αiαj stays an involution wherever αi or αj changes. Two explicit links: the square
//    closes. One explicit, one implicit: the node across has the implicit one at the same position. Two
//    implicit: the *hook's* links at those positions commute, whatever they are renamed to.
// 3. Hooks: one in every connected component of the left graph, its label without `_`; labels are equally long.
// 4. Points: a vertex made of created darts alone has one expression, any other vertex none.
//
// A violation calls a function that is not constexpr and is named after it, so that the compiler's message
// shows the reason. g++ does not print the arguments; at run time rule_check::all(rule) throws InternalError,
// which names the node and its links.
#pragma once

#include "sim/topology/rule.h"

namespace rend {

namespace rule_fault {
[[noreturn]] void node_is_unknown(char node);
[[noreturn]] void node_is_named_twice(char node);
[[noreturn]] void there_is_no_such_link(char node, int i); // only α0..α3
[[noreturn]] void link_is_said_twice(char node, int i);
[[noreturn]] void arc_should_be_a_loop(char node, int i);
[[noreturn]] void labels_differ_in_length(char node);
[[noreturn]] void hook_is_missing(char node); // in the component of that node
[[noreturn]] void component_has_two_hooks(char node);
[[noreturn]] void hook_is_on_the_right(char node);
[[noreturn]] void hook_drops_a_link(char node);
[[noreturn]] void link_is_missing(char node, int i);
[[noreturn]] void kept_node_gains_a_link(char node, int i);
[[noreturn]] void kept_node_loses_a_link(char node, int i);
[[noreturn]] void removed_node_dangles(char node, int i);
[[noreturn]] void cycle_is_broken(char node, int i, int j);
[[noreturn]] void new_vertex_without_point(char node);
[[noreturn]] void new_vertex_with_two_points(char node);
[[noreturn]] void point_of_a_kept_vertex(char node);
[[noreturn]] void point_on_the_left(char node);
[[noreturn]] void point_from_unknown_node(char node); // the source is not a node of the left graph
} // namespace rule_fault

namespace rule_check {

// How often a graph specifies αi of a node.
constexpr int times_said(const RuleGraph& graph, int node, int i) {
  const RuleNode& at = graph[node];
  int times = 0;
  for (int p = 0; p < at.label.size; ++p) times += at.label[p] == i;
  for (const RuleLoop& loop : graph.loops) times += loop.node == at.name && (loop.links >> i & 1);
  for (const RuleArc& arc : graph.arcs) times += arc.link == i && (arc.from == at.name || arc.to == at.name);
  return times;
}

constexpr void labels(const RuleGraph& graph, int length) {
  for (int n = 0; n < graph.size(); ++n) {
    const RuleNode& node = graph[n];
    if (graph.find(node.name) != n) rule_fault::node_is_named_twice(node.name);
    if (node.label.size != length || length > static_cast<int>(Label::capacity))
      rule_fault::labels_differ_in_length(node.name);
    for (int p = 0; p < length; ++p)
      if (node.label[p] < Label::dropped || node.label[p] > 3)
        rule_fault::there_is_no_such_link(node.name, node.label[p]);
    for (int i = 0; i < 4; ++i)
      if (times_said(graph, n, i) > 1) rule_fault::link_is_said_twice(node.name, i);
  }
}

constexpr void arcs(const RuleGraph& graph) {
  for (const RuleArc& arc : graph.arcs) {
    if (graph.find(arc.from) < 0) rule_fault::node_is_unknown(arc.from);
    if (graph.find(arc.to) < 0) rule_fault::node_is_unknown(arc.to);
    if (arc.link < 0 || arc.link > 3) rule_fault::there_is_no_such_link(arc.from, arc.link);
    if (arc.from == arc.to) rule_fault::arc_should_be_a_loop(arc.from, arc.link);
  }
  for (const RuleLoop& loop : graph.loops) {
    if (graph.find(loop.node) < 0) rule_fault::node_is_unknown(loop.node);
    if (loop.links > 15) rule_fault::there_is_no_such_link(loop.node, 4);
  }
}

// Marks the nodes reached from `first` by arcs whose link is in `allowed`.
constexpr std::array<bool, 16> reach(const RuleGraph& graph, int first, unsigned allowed) {
  std::array<bool, 16> marked{};
  marked[static_cast<std::size_t>(first)] = true;
  for (bool grows = true; grows;) {
    grows = false;
    for (const RuleArc& arc : graph.arcs) {
      bool& from = marked[static_cast<std::size_t>(graph.find(arc.from))];
      bool& to = marked[static_cast<std::size_t>(graph.find(arc.to))];
      if (!(allowed >> arc.link & 1) || from == to) continue;
      from = to = grows = true;
    }
  }
  return marked;
}

constexpr void hooks(const Rule& rule) {
  for (const RuleNode& node : rule.right.nodes)
    if (node.hook) rule_fault::hook_is_on_the_right(node.name);
  for (int n = 0; n < rule.left.size(); ++n) {
    const RuleNode& node = rule.left[n];
    const auto component = reach(rule.left, n, 15);
    int count = 0;
    for (int m = 0; m < rule.left.size(); ++m)
      count += component[static_cast<std::size_t>(m)] && rule.left[m].hook;
    if (count == 0) rule_fault::hook_is_missing(node.name);
    if (count > 1) rule_fault::component_has_two_hooks(node.name);
    if (node.hook && node.label.position(Label::dropped) >= 0) rule_fault::hook_drops_a_link(node.name);
  }
}

constexpr void incident_arc(const Rule& rule, char node, int i) {
  const int before = rule.left.find(node), after = rule.right.find(node);
  const int had = before < 0 ? 0 : times_said(rule.left, before, i);
  const int has = after < 0 ? 0 : times_said(rule.right, after, i);
  if (before < 0 && !has) rule_fault::link_is_missing(node, i);
  if (after < 0 && !had) rule_fault::removed_node_dangles(node, i);
  if (before >= 0 && after >= 0 && has > had) rule_fault::kept_node_gains_a_link(node, i);
  if (before >= 0 && after >= 0 && has < had) rule_fault::kept_node_loses_a_link(node, i);
}

constexpr void incident_arcs(const Rule& rule) {
  for (int i = 0; i < 4; ++i) {
    for (const RuleNode& node : rule.left.nodes) incident_arc(rule, node.name, i);
    for (const RuleNode& node : rule.right.nodes) incident_arc(rule, node.name, i);
  }
}

// Whether αiαj is an involution at a node of the right graph whose αi or αj is new.
constexpr bool cycle_closes(const Rule& rule, int node, int i, int j) {
  using Kind = RuleLink::Kind;
  const RuleGraph& graph = rule.right;
  const RuleLink by_i = graph.link(node, i), by_j = graph.link(node, j);
  if (by_i.kind == Kind::Absent || by_j.kind == Kind::Absent)
    return false; // the opposite side of the square is unknown
  if (by_i.kind == Kind::Implicit && by_j.kind == Kind::Implicit) {
    const int p = rule.positions()[by_i.to], q = rule.positions()[by_j.to];
    return p - q >= 2 || q - p >= 2;
  }
  if (by_i.kind == Kind::Implicit) return graph.link(by_j.to, i) == by_i;
  if (by_j.kind == Kind::Implicit) return graph.link(by_i.to, j) == by_j;
  const RuleLink around_i = graph.link(by_i.to, j), around_j = graph.link(by_j.to, i);
  if (around_i.kind != Kind::Arc && around_i.kind != Kind::Loop) return false;
  if (around_j.kind != Kind::Arc && around_j.kind != Kind::Loop) return false;
  return around_i.to == around_j.to;
}

constexpr void cycle(const Rule& rule, char node, int i, int j) {
  const int before = rule.left.find(node), after = rule.right.find(node);
  if (before >= 0 && rule.unchanged(before, after, i) && rule.unchanged(before, after, j)) return;
  if (!cycle_closes(rule, after, i, j)) rule_fault::cycle_is_broken(node, i, j);
}

constexpr void cycles(const Rule& rule) {
  for (const RuleNode& node : rule.right.nodes)
    for (int i = 0; i < 4; ++i)
      for (int j = i + 2; j < 4; ++j) cycle(rule, node.name, i, j);
}

// Whether the vertex of a node of the right graph has the point expressions it needs.
constexpr void vertex_point(const Rule& rule, char node) {
  const auto vertex = reach(rule.right, rule.right.find(node), 0b1110); // α1, α2, α3
  int said = 0;
  bool kept = false;
  for (int m = 0; m < rule.right.size(); ++m)
    kept = kept || (vertex[static_cast<std::size_t>(m)] && rule.left.find(rule.right[m].name) >= 0);
  for (const RulePoint& point : rule.right.points)
    said += vertex[static_cast<std::size_t>(rule.right.find(point.node))];
  if (kept && said > 0) rule_fault::point_of_a_kept_vertex(node);
  if (!kept && said == 0) rule_fault::new_vertex_without_point(node);
  if (!kept && said > 1) rule_fault::new_vertex_with_two_points(node);
}

constexpr void points(const Rule& rule) {
  for (const RulePoint& point : rule.left.points) rule_fault::point_on_the_left(point.node);
  for (const RulePoint& point : rule.right.points) {
    if (rule.right.find(point.node) < 0) rule_fault::node_is_unknown(point.node);
    if (point.source.kind != PointSource::Kind::Given && rule.left.find(point.source.node) < 0)
      rule_fault::point_from_unknown_node(point.node);
  }
  for (const RuleNode& node : rule.right.nodes) vertex_point(rule, node.name);
}

constexpr void all(const Rule& rule) {
  const int length = rule.positions().size;
  // First that names and links exist, which the other checks rely on.
  arcs(rule.left);
  arcs(rule.right);
  hooks(rule);
  labels(rule.left, length);
  labels(rule.right, length);
  incident_arcs(rule);
  cycles(rule);
  points(rule);
}

} // namespace rule_check

// True, or not a constant expression: the compiler's message names the violation.
consteval bool well_formed(const Rule& rule) {
  rule_check::all(rule);
  return true;
}

} // namespace rend
