// Graph transformation rules: a change of the map described by two graphs, as in Jerboa (thesis 3.4.1; Poudret
// 2009; Belhaouari et al. 2014).
//
//   Rule{"unsew edge",  left{hook('a', {0}), node('b', {0}), arc('a', 2, 'b')},          a ─2─ b
//                       right{node('a', {0}), node('b', {0}), loop('a', 2), loop('b', 2)}}   →   a ↺2   b ↺2
//
// A node stands for every dart of an orbit at once. The label of a hook is that orbit: hook('a', {0, 1})
// matches a whole face, however many sides it has. Each dart of the hook's orbit is an *instance* of the rule:
// there, every other node has one dart. Position k of any label refers to the k-th link of the hook's label: it
// is kept, renamed, or dropped (`_`); {_, 2} on a <0,1> hook means "no link where the hook has α0; α2 where the
// hook has α1". Arcs link two nodes at each instance; a loop is a free link. Darts of nodes on both sides are
// kept, those of nodes on the left alone are removed, those of nodes on the right alone are created.
//
// Every connected component of the left graph has one hook, so that the match is unique. New vertices have a
// point expression: point('d', mean('a', FaceOfVolume)). Whether a rule preserves the axioms is decided at
// compile time: rule_check.h.
#pragma once

#include "sim/topology/gmap.h"

#include <array>
#include <cstdint>
#include <initializer_list>
#include <span>

namespace rend {

// The links of a node, position by position.
struct Label {
  static constexpr int dropped = -1;
  static constexpr std::size_t capacity = 4;

  std::array<int, capacity> links{};
  int size = 0; // more than `capacity`: refused by rule_check.h

  constexpr Label() = default;
  constexpr Label(std::initializer_list<int> list) {
    for (int link : list) {
      if (static_cast<std::size_t>(size) < capacity) links[static_cast<std::size_t>(size)] = link;
      ++size;
    }
  }
  constexpr int operator[](int position) const { return links[static_cast<std::size_t>(position)]; }
  constexpr int position(int link) const { // -1: the label does not hold it
    for (int p = 0; p < size && p < static_cast<int>(capacity); ++p)
      if (links[static_cast<std::size_t>(p)] == link) return p;
    return -1;
  }
};

struct RuleNode {
  char name = 0;
  Label label;
  bool hook = false;
};

struct RuleArc {
  char from = 0;
  int link = 0;
  char to = 0;
};

struct RuleLoop {
  char node = 0;
  unsigned links = 0; // bit i: αi is free
};

// The position of a new vertex; rest position and velocity are derived in the same way.
struct PointSource {
  enum class Kind { Copy, Mean, Given, Translated };
  Kind kind = Kind::Given;
  char node = 0;    // of the left graph; Given has none
  Orbit orbit;      // Mean: over the distinct vertices of this orbit of the node's dart
  int argument = 0; // Given: which point, Translated: which vector of the arguments
};

struct RulePoint {
  char node = 0;
  PointSource source;
};

// What αi of a node is.
struct RuleLink {
  enum class Kind { Absent, Implicit, Arc, Loop };
  Kind kind = Kind::Absent;
  int to = -1; // Implicit: position in the label. Arc: node at the other end. Loop: the node itself
  friend constexpr bool operator==(const RuleLink&, const RuleLink&) = default;
};

// A list of bounded length that can be part of a constant expression.
template <class T, std::size_t N> struct FixedList {
  std::array<T, N> items{};
  std::size_t count = 0;

  constexpr void push_back(const T& item) {
    items.at(count++) = item;
  } // std::array::at: a list that is too long is no constant expression
  constexpr std::size_t size() const { return count; }
  constexpr const T& operator[](std::size_t n) const { return items[n]; }
  constexpr const T* begin() const { return items.data(); }
  constexpr const T* end() const { return items.data() + count; }
};

class RuleGraph {
public:
  template <class... Elements> constexpr explicit RuleGraph(const Elements&... elements) {
    (add(elements), ...);
  }

  constexpr int size() const { return static_cast<int>(nodes.size()); }
  constexpr const RuleNode& operator[](int node) const { return nodes[static_cast<std::size_t>(node)]; }
  constexpr int find(char name) const { // -1: no such node
    for (int n = 0; n < size(); ++n)
      if ((*this)[n].name == name) return n;
    return -1;
  }
  constexpr RuleLink link(int node, int i) const;

  FixedList<RuleNode, 12> nodes;
  FixedList<RuleArc, 20> arcs;
  FixedList<RuleLoop, 16> loops;
  FixedList<RulePoint, 12> points;

private:
  constexpr void add(const RuleNode& node) { nodes.push_back(node); }
  constexpr void add(const RuleArc& arc) { arcs.push_back(arc); }
  constexpr void add(const RuleLoop& loop) { loops.push_back(loop); }
  constexpr void add(const RulePoint& point) { points.push_back(point); }
};

constexpr RuleLink RuleGraph::link(int node, int i) const {
  const RuleNode& at = (*this)[node];
  if (const int p = at.label.position(i); p >= 0) return {RuleLink::Kind::Implicit, p};
  for (const RuleLoop& loop : loops)
    if (loop.node == at.name && (loop.links >> i & 1)) return {RuleLink::Kind::Loop, node};
  for (const RuleArc& arc : arcs) {
    if (arc.link != i) continue;
    if (arc.from == at.name) return {RuleLink::Kind::Arc, find(arc.to)};
    if (arc.to == at.name) return {RuleLink::Kind::Arc, find(arc.from)};
  }
  return {};
}

// A further condition for the rule to apply, evaluated after the match: null, or a sentence that says what does
// not hold.
using Precondition = const char* (*)(const GMap& map, std::span<const Dart> hooks);

// The notation of rules, for the files of sim/rules.
namespace grammar {

inline constexpr int _ = Label::dropped;

struct left : RuleGraph {
  using RuleGraph::RuleGraph;
};
struct right : RuleGraph {
  using RuleGraph::RuleGraph;
};

constexpr RuleNode node(char name, const Label& label = {}) {
  return {name, label, false};
}
constexpr RuleNode hook(char name, const Label& label = {}) {
  return {name, label, true};
}
constexpr RuleArc arc(char from, int link, char to) {
  return {from, link, to};
}

template <class... Links> constexpr RuleLoop loop(char name, Links... links) {
  return {name, ((1u << links) | ... | 0u)};
}

constexpr RulePoint point(char node, const PointSource& source) {
  return {node, source};
}

constexpr PointSource copy(char node) {
  return {PointSource::Kind::Copy, node, {}, 0};
}
constexpr PointSource mean(char node, Orbit orbit) {
  return {PointSource::Kind::Mean, node, orbit, 0};
}
constexpr PointSource given(int argument) {
  return {PointSource::Kind::Given, 0, {}, argument};
}
constexpr PointSource translated(char node, int argument = 0) {
  return {PointSource::Kind::Translated, node, {}, argument};
}

} // namespace grammar

struct Rule {
  constexpr Rule(const char* name_, const grammar::left& before, const grammar::right& after,
                 Precondition precondition_ = nullptr)
      : name(name_), left(static_cast<const RuleGraph&>(before)), right(static_cast<const RuleGraph&>(after)),
        precondition(precondition_) {}

  // The link is the same before and after (or the rule does not mention it), and both ends are kept.
  constexpr bool unchanged(int left_node, int right_node, int i) const {
    const RuleLink before = left.link(left_node, i), after = right.link(right_node, i);
    if (before.kind != after.kind) return false;
    if (before.kind != RuleLink::Kind::Arc)
      return before.kind != RuleLink::Kind::Implicit || before.to == after.to;
    return before.to >= 0 && after.to >= 0 && left[before.to].name == right[after.to].name;
  }

  // The label of the first hook, which positions refer to; empty for a rule that only creates.
  constexpr const Label& positions() const {
    for (const RuleNode& node : left.nodes)
      if (node.hook) return node.label;
    return no_label_;
  }

  const char* name;
  RuleGraph left, right;
  Precondition precondition;

private:
  Label no_label_;
};

} // namespace rend
