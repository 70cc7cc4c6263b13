// Which vertices of a map a rule joins, decided from its graphs alone.
//
// A vertex of the right graph is what α1, α2 and α3 reach: by arcs within an instance, and by labels from one
// instance to the next. Its kept darts belonged to one vertex before if the left graph leads from each to the
// others in the same way; where αiαj is an involution (j >= i + 2), three sides of a square stand for the
// fourth. Where it does not lead there, the rule may join two vertices, and which of their points counts would
// hang on the numbers of darts: a <set> has to say it.
#pragma once

#include "sim/rules/rule_graph.h"

#include <optional>
#include <string>
#include <vector>

namespace rend {

struct VertexJoin {
  int first = -1, second = -1; // nodes of the left graph, of two vertices; one node: at two instances
  int position = -1;           // of the labels: what leads from one instance to the other; -1: the same one
};

class VertexJoins {
public:
  // `before`: as of Rule.
  VertexJoins(const RuleGraph& left, const RuleGraph& right, const std::vector<int>& before);

  // Of the vertex of a node of the right graph; nullopt: its kept darts are of one vertex, or none is kept.
  std::optional<VertexJoin> at(int right_node) const;

private:
  void complete_squares();
  bool completes(int node, int i, int j);
  bool spans(const RuleGraph& graph, const std::vector<bool>& vertex, std::size_t position) const;

  RuleGraph left_; // with the links that follow
  const RuleGraph& right_;
  const std::vector<int>& before_;
};

} // namespace rend
