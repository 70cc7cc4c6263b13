// The two graphs of a rule, and the notation in which they are written (thesis 3.4.1; Poudret 2009; Belhaouari
// et al. 2014, whose program Jerboa draws the same graphs).
//
//   a*(0,1,2)   a node, with a star: a hook. It stands for every dart of the orbit <0,1,2> of one dart at once
//   b(_,1,2)    a node. At each dart of the hook's orbit, an *instance* of the rule, every node has one dart.
//               Position k of a label tells what the k-th link of the hook's label becomes for this node: kept,
//               renamed, or dropped (_)
//   c           a node with an empty label, as all have where the hook stands for a single dart
//   a-2-b       an arc: α2 links the darts of a and b, at each instance
//   a|2,3       free links: α2 and α3 of a lead to the dart itself
//
// Items are separated by blanks, in any order. Names are words: a letter, then letters, digits and _.
#pragma once

#include "sim/topology/orbit.h"

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace rend {

// What αi of a node is.
struct RuleLink {
  enum class Kind : std::uint8_t { Absent, Implicit, Arc, Loop };
  Kind kind = Kind::Absent;
  int to = -1; // Implicit: position in the label. Arc: node at the other end. Loop: the node itself
  friend bool operator==(const RuleLink&, const RuleLink&) = default;
};

struct RuleNode {
  static constexpr int dropped = -1;

  std::string name;
  std::vector<int> label; // links, or `dropped`; as many as the hook has
  bool hook = false;
  std::array<RuleLink, 4> links; // of α0 to α3
  std::size_t column = 0;        // of its name in the text, from 1

  int position(int link) const; // in the label; -1: it does not hold that link
};

enum class RuleSide { Left, Right };
const char* name_of(RuleSide side); // "left", "right"

// What is wrong with a rule's graphs, and where.
struct RuleFault : std::runtime_error {
  RuleFault(RuleSide side, std::size_t column, const std::string& what, const std::string& hint = {});
  RuleSide side;
  std::size_t column; // in the text of that side, from 1; 0: the side as a whole
  std::string hint;   // may be empty
};

struct RuleGraph {
  static constexpr std::size_t longest = 32768; // characters of a text
  static constexpr std::size_t longest_name = 50;
  static constexpr std::size_t most_nodes = 1000;

  std::vector<RuleNode> nodes;

  // RuleFault: what does not follow the notation, what names no node, what is said twice of a link.
  static RuleGraph parse(RuleSide side, std::string_view text);

  int size() const { return static_cast<int>(nodes.size()); }
  const RuleNode& operator[](int node) const { return nodes[static_cast<std::size_t>(node)]; }
  const RuleLink& link(int node, int i) const { return (*this)[node].links[static_cast<std::size_t>(i)]; }
  int find(std::string_view name) const; // -1: no such node

  // The nodes that arcs lead to from `node`, itself included, whose links are all in `allowed`; one flag a
  // node.
  std::vector<bool> reach(int node, Orbit allowed) const;

  // In the notation: parses to the same graph.
  std::string print() const;
};

} // namespace rend
