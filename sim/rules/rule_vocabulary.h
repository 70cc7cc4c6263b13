// The words that the expressions of a rule know, what they mean, and which arguments they take.
//
//   a                    the point of node a of the left graph
//   alpha(a, 2)          the dart that α2 links to that of a: its point, or, where a name is expected, the dart
//   copy(a)              the point of a
//   mean(a, face)        the mean of the distinct vertices of a's vertex, edge, face, volume or component
//   mean(a, neighbours)  the mean of the vertices at the other ends of the edges at a's vertex; border: of
//    those along
//                        the border of a sheet or the hull of a solid
//   mean(a, faces)       the mean of the middles of the faces at a's vertex; volumes: likewise
//   lerp(u, v, t)        (1 − t) u + t v
//   along(a, normal, h)  a, moved by h [m] along the normal of its vertex; of its face; or along its edge
//   normal(a, face)      the unit normal of its face; of its vertex
//   size(a, face)        how many of those that the mean is of; of a vertex: how many edges
//   length(a), area(a), volume(a)   of its edge, face, volume, at rest [m, m², m³]
//   free(a, 3)           whether α3 of a is free
//   marked(a, m)         whether a step with mark="m" of the script that runs has matched or made it; elsewhere
//    false
//
// and, of a rule that a law of tearing applies (RuleQuantities; elsewhere these are refused before anything
// runs):
//
//   stress(a, element), strain(a, element)  the largest principal value of the stress [Pa], of the strain, of
//                        a's element: a face of a sheet, a volume of a solid
//   stress(a, vertex), strain(a, vertex)    of their mean at a's vertex, by masses of the elements around it
//   value                what the criterion found, in the unit of its threshold
//   across               the unit normal of the plane along which a vertex would be split
//   time                 [s]
#pragma once

#include "sim/expression/expression.h"
#include "sim/rules/rule_graph.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rend {

// The functions that expressions of a rule may call, in this order; then its nodes, its arguments and its lets,
// as variables.
enum class RuleFunction : std::size_t {
  Alpha,
  Copy,
  Mean,
  Lerp,
  Along,
  Normal,
  Size,
  LengthOf,
  AreaOf,
  VolumeOf,
  Free,
  Marked,
  Stress,
  Strain,
  Found,
  Across,
  Time
};
constexpr std::size_t rule_functions = static_cast<std::size_t>(RuleFunction::Time) + 1;

// Of a rule with these nodes on the left and these arguments.
std::vector<ExpressionFunction> rule_vocabulary(const RuleGraph& left, std::span<const std::string> wheres);

// Throws ExpressionError: a call that names no node of the left graph, or nothing that has vertices.
void check_names(const Expression& expression, const RuleGraph& left);

// What the vertices of a mean are.
enum class MeanOf { Orbit, Neighbours, Border, Faces, Volumes };
MeanOf mean_of_name(std::string_view name);

// The orbit within which a call has one value; `links`: of `free`, the link that it asks for, else -1.
Orbit orbit_of_call(const ExpressionCall& call, int link = -1);

// A dart as a name: alpha(alpha(a, 1), 0) is that of node a, then α1, then α0.
struct NamedDart {
  std::string_view node;
  std::string links;     // "10"
  std::size_t calls = 0; // of alpha; as many as links, if each is one
};
NamedDart named_dart(std::string_view name);
bool is_node(const ExpressionCall& call, const RuleGraph& left);
// The name of the dart that a call is about; empty: about none.
std::string_view dart_of_call(const ExpressionCall& call, const RuleGraph& left);

} // namespace rend
