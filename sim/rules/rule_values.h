// What the expressions of a rule speak of, and their values at one instance of a match.
//
//   a                    the point of node a of the left graph
//   copy(a)              the same
//   mean(a, face)        the mean of the distinct vertices of a's vertex, edge, face, volume or component
//   lerp(u, v, t)        (1 − t) u + t v
//   along(a, normal, h)  a, moved by h [m] along the normal of its vertex; of its face; or along its edge
//   size(a, face)        how many vertices; of a vertex: how many edges
//   length(a), area(a), volume(a)   of its edge, face, volume, at rest [m, m², m³]
//   free(a, 3)           whether α3 of a is free
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
//
// The position is the value of the expression over positions; the rest position that over rest positions; the
// velocity its derivative in time where points move with their velocities: f(v) − f(0) for an affine
// expression.
//
// Normals need a sense: out of a volume; of a sheet, and of a face in a solid that encloses nothing, the side
// on which its component's smallest dart lies.
#pragma once

#include "sim/embedding/embedded_map.h"
#include "sim/rules/map_budget.h"
#include "sim/rules/match.h"
#include "sim/topology/orientation.h"

#include <span>

namespace rend {

// The functions that expressions of a rule may call, in this order; then its nodes and arguments, as variables.
enum class RuleFunction : std::size_t {
  Copy,
  Mean,
  Lerp,
  Along,
  Size,
  LengthOf,
  AreaOf,
  VolumeOf,
  Free,
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

// Whether a call has the same value at an instance and at the one that position `p` of the labels leads to.
bool keeps_value(const ExpressionCall& call, const RuleGraph& left, int p);

// Quantities that are known above the map. They are those from before the edit: an element or vertex that was
// changed since has the value of what it was, and one that was born the mean of its parents' values.
class RuleQuantities {
public:
  enum class Of { InElement, AtVertex };
  virtual ~RuleQuantities() = default;
  // [Pa] and a ratio. ExpressionError: of what was born without parents.
  virtual double stress(const Edit& edit, Dart d, Of of) = 0;
  virtual double strain(const Edit& edit, Dart d, Of of) = 0;
  double value = 0;           // what the criterion found, in its unit
  Vec3 across = Vec3::Zero(); // unit normal of the plane along which a vertex would be split
  double time = 0;            // [s]
};

// Where a rule is applied.
struct RuleContext {
  std::vector<Value> wheres = {};             // the rule's arguments; empty: their defaults
  RuleQuantities* quantities = nullptr;       // null: there is no law
  mutable std::optional<Sides> sides = {};    // of the map when it was first asked for
  std::size_t most_darts = MapBudget{}.darts; // that a map may grow to (map_budget.h)
};

enum class PointPart { Position, Rest, Velocity };

// The values of a rule's expressions in one match.
class RuleValues {
public:
  RuleValues(const Rule& rule, const Edit& edit, const Match& match, const RuleContext& context)
      : rule_(rule), edit_(edit), match_(match), context_(context) {}

  // ExpressionError: a value that is not finite.
  Point point(const Rule::Set& set, std::size_t instance) const;
  Point moved(const Rule::Set& set, std::size_t instance,
              const Point& was) const; // keeps what has no expression
  bool holds(const Rule::When& when) const;
  Value value(const Expression& expression, std::size_t instance) const; // over positions
  // The vertices that the position is made of, with equal weights; none: it is made of numbers.
  void parents(const Rule::Set& set, std::size_t instance, std::vector<Parent>& out) const;

private:
  Vec3 vector(const Expression& expression, std::size_t instance, PointPart part, bool at_zero = false) const;
  Value call(const ExpressionCall& call, std::span<const Value> arguments, std::size_t instance, PointPart part,
             bool at_zero) const;
  Value quantity(const ExpressionCall& call, Dart d) const;
  Dart dart(std::string_view node, std::size_t instance) const;
  Vec3 part_of(Dart d, PointPart part) const;
  Vec3 direction(Dart d, std::string_view which, PointPart part) const;
  double side(Dart d) const; // 1, −1

  // Position, rest, velocity and heirs of a vertex all ask for the same mean: the last one is kept.
  struct Mean {
    const ExpressionCall* call = nullptr;
    std::size_t instance = 0;
    std::vector<Dart> vertices;
    Point point;
  };
  const Mean& mean_of(const ExpressionCall& call, std::size_t instance) const;

  const Rule& rule_;
  const Edit& edit_;
  const Match& match_;
  const RuleContext& context_;
  mutable Mean mean_;
};

} // namespace rend
