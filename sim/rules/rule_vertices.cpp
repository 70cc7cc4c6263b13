#include "sim/rules/rule_vertices.h"

namespace rend {

using Kind = RuleLink::Kind;

VertexJoins::VertexJoins(const RuleGraph& left, const RuleGraph& right, const std::vector<int>& before)
    : left_(left), right_(right), before_(before) {
  complete_squares();
}

// Adds the links of the left graph that follow from αiαj being involutions, until there are no more.
void VertexJoins::complete_squares() {
  for (bool more = true; more;) {
    more = false;
    for (int n = 0; n < left_.size(); ++n)
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
          if (i - j >= 2 || j - i >= 2) more = completes(n, i, j) || more;
  }
}

// αj of a node, from αi, αj, αi.
bool VertexJoins::completes(int node, int i, int j) {
  const RuleLink out = left_.link(node, i);
  RuleLink& missing = left_.nodes[static_cast<std::size_t>(node)].links[static_cast<std::size_t>(j)];
  if (missing.kind != Kind::Absent || out.kind != Kind::Arc) return false;
  const RuleLink across = left_.link(out.to, j);
  if (across.kind == Kind::Implicit) {
    missing = across;
    return true;
  }
  if (across.kind != Kind::Arc) return false;
  const RuleLink back = left_.link(across.to, i);
  if (back.kind != Kind::Arc) return false;
  missing = {Kind::Arc, back.to};
  return true;
}

// Whether a vertex goes on at the instance that a position of the labels leads to.
bool VertexJoins::spans(const RuleGraph& graph, const std::vector<bool>& vertex, std::size_t position) const {
  for (std::size_t n = 0; n < vertex.size(); ++n)
    for (int i = 1; vertex[n] && i < 4; ++i)
      if (graph.nodes[n].links[static_cast<std::size_t>(i)] ==
          RuleLink{Kind::Implicit, static_cast<int>(position)})
        return true;
  return false;
}

std::optional<VertexJoin> VertexJoins::at(int right_node) const {
  const std::vector<bool> vertex = right_.reach(right_node, Vertex);
  int first = -1;
  std::vector<bool> was;
  for (std::size_t n = 0; n < vertex.size(); ++n) {
    const int kept = vertex[n] ? before_[n] : -1;
    if (kept < 0) continue;
    if (first >= 0 && !was[static_cast<std::size_t>(kept)]) return VertexJoin{first, kept, -1};
    if (first >= 0) continue;
    first = kept;
    was = left_.reach(first, Vertex);
  }
  if (first < 0) return {};
  for (std::size_t p = 0; p < left_[first].label.size(); ++p)
    if (spans(right_, vertex, p) && !spans(left_, was, p)) return VertexJoin{first, first, static_cast<int>(p)};
  return {};
}

} // namespace rend
