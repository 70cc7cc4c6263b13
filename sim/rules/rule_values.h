// The values of the expressions of a rule (rule_vocabulary.h) at one instance of a match.
//
// The position is the value of the expression over positions; the rest position that over rest positions; the
// velocity its derivative in time, where points move with their velocities (Expression::evaluate_with_rate).
// Measures at rest, arguments and what a law tells do not change in time, but for time itself. In
// velocity="..." a node stands for its velocity.
//
// A vertex that is kept, and moves in a law, keeps its rest position unless rest="..." gives one: it is
// displaced, and the matter is strained by that. Where a body is constructed, and where a rule joins two
// vertices, rest follows.
#pragma once

#include "sim/embedding/embedded_map.h"
#include "sim/rules/map_budget.h"
#include "sim/rules/match.h"
#include "sim/rules/rule_directions.h"
#include "sim/rules/rule_marks.h"
#include "sim/rules/rule_vocabulary.h"

#include <span>
#include <vector>

namespace rend {

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
  const RuleMarks* marks = nullptr;           // of the script that runs; null: none does
};

enum class PointPart { Position, Rest, Velocity };

// The values of a rule's expressions in one match.
class RuleValues {
public:
  RuleValues(const Rule& rule, const Edit& edit, const Match& match, const RuleContext& context)
      : rule_(rule), edit_(edit), match_(match), context_(context), lets_(rule.lets.size()) {}

  // Of a new vertex, or one of two that are joined. ExpressionError: a value that is not finite.
  Point point(const Rule::Set& set, std::size_t instance) const;
  // Of one that is kept: what has no expression stays as it was.
  Point moved(const Rule::Set& set, std::size_t instance, const Point& was) const;
  bool holds(const Rule::When& when) const;
  Value value(const Expression& expression, std::size_t instance) const; // over positions
  // The vertices that the position is made of, with their weights in it: 1 − t and t in lerp(a, b, t). They are
  // equal where the position is no mean of vertices whose weights are constant and not negative. None: the
  // position is made of numbers.
  void parents(const Rule::Set& set, std::size_t instance, std::vector<Parent>& out) const;

private:
  void place(const Rule::Set& set, std::size_t instance, bool rest_follows, Point& point) const;
  Vec3 vector(const Expression& expression, std::size_t instance, PointPart part) const;
  Value call(const ExpressionCall& call, std::span<const Value> arguments, std::size_t instance,
             PointPart part) const;
  // Over positions.
  Value rate(const ExpressionCall& call, std::span<const Value> arguments, std::span<const Value> rates,
             std::size_t instance) const;
  // Both, over positions.
  ValueAndRate moving(const Expression& expression, std::size_t instance) const;
  Value let(const Rule::Let& let, std::size_t instance, PointPart part) const;
  Value rate_of_let(const Rule::Let& let, std::size_t instance) const;
  Value quantity(const ExpressionCall& call, Dart d) const;
  double count(const ExpressionCall& call, std::size_t instance) const;
  Dart dart(std::string_view name, std::size_t instance) const; // a node, or alpha(...)
  Vec3 part_of(Dart d, PointPart part) const;

  // Position, rest, velocity and heirs of a vertex all ask for the same mean: the last one is kept.
  struct Mean {
    const ExpressionCall* call = nullptr;
    std::size_t instance = 0;
    std::vector<Dart> vertices;
    Point point;
  };
  const Mean& mean_of(const ExpressionCall& call, std::size_t instance) const;
  // A call whose value is a vertex, or the mean of some.
  struct Source {
    const ExpressionCall* call;
    double weight; // in the position
  };
  // `met`: the lets that are done, one flag each.
  void add_sources(const Expression& expression, std::vector<bool>& met, std::vector<Source>& out) const;
  void add_parents(const Source& source, std::size_t instance, std::vector<Parent>& out) const;
  // False where the value is no mean of its sources.
  bool weigh(const Expression& expression, std::size_t instance, std::span<Source> sources) const;
  // d(value)/ds, where the source alone moves by s (1, 1, 1) and the t of every lerp stands still.
  Value rate_by(const Source& source, const Expression& expression, std::size_t instance) const;

  // What a let was found to be: expressions may use it often.
  struct Known {
    bool value_known = false, rate_known = false;
    std::size_t instance = 0;
    PointPart part = PointPart::Position; // of the value
    std::size_t instance_of_rate = 0;
    Value value, rate;
  };

  const Rule& rule_;
  const Edit& edit_;
  const Match& match_;
  const RuleContext& context_;
  mutable Mean mean_;
  mutable std::vector<Known> lets_; // one per let of the rule
};

} // namespace rend
