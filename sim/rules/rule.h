// A graph transformation rule, checked and compiled: what the engine runs.
//
// Its graphs say which darts are matched and what takes their place (rule_graph.h), its expressions where
// vertices are (rule_values.h). A rule is immutable; what is compiled once, the *plan*, lists the steps of a
// match and of the rewriting node by node, so that running it reads no names.
#pragma once

#include "sim/expression/expression.h"
#include "sim/rules/rule_graph.h"
#include "sim/rules/rule_settings.h"

#include <optional>
#include <string>
#include <vector>

namespace rend {

// Numbers of nodes are those of the left graph, if not said otherwise.
struct RulePlan {
  // The dart of `node` is found from that of `from`.
  struct Step {
    int node, from, link;
  };
  // A link that must be there at every instance, and does not follow from the steps and the axioms.
  struct Test {
    int node, link;
    RuleLink::Kind kind; // Implicit, Arc or Loop
    int to;              // as in RuleLink
  };
  struct Link {
    int node, link;      // of the right graph
    RuleLink::Kind kind; // Implicit or Arc
    int to;              // as in RuleLink
  };
  std::vector<int> hooks;
  std::vector<Step> steps;
  std::vector<Test> tests;
  std::vector<Test> first_tests; // of hooks' loops and arcs: asked of the hooks' own darts before anything else
  std::vector<std::pair<int, int>> unlinks; // node, link
  std::vector<int> removed;                 // nodes
  std::vector<Link> links;
  // Of each node of the right graph, in a sheet and in a solid: the node of the left graph in whose element a
  // created dart comes to lie; -1: it is kept, or its element lies in none that is there.
  std::array<std::vector<int>, 2> inside;
  bool links_volumes = false; // it links by α3
  bool needs_volumes = false; // it does, or asks for a neighbour by α3: it can never apply to a sheet
};

// What is well formed, and goes wrong in some maps.
struct RuleWarning {
  Place place;
  std::string what, hint; // the hint may be empty
};

struct Rule {
  // UserError (65) with the place of the attribute: everything that `rend rule check` refuses. `kind`: what
  // messages call it, which may be a part of a script.
  explicit Rule(RuleSettings settings, const char* kind = "rule");
  Rule(Rule&&) = default;

  // The values of a vertex; empty where they follow the position.
  struct Set {
    int node = -1; // of the right graph
    std::optional<Expression> position, rest, velocity;
  };
  struct When {
    Expression test;
    RuleWhenSettings::At at;
    std::string otherwise;
  };
  struct Where {
    std::string name;
    ValueType type; // Scalar or Vector
    Value value;
  };

  struct Let {
    static constexpr int deepest = 20; // lets that use each other
    std::string name;
    Expression value;
    int depth; // of the lets that it uses, and itself
  };

  const std::string& name() const { return settings.name; }
  const Let* find_let(const ExpressionCall& call) const; // null: it is none
  Orbit hook_orbit(std::size_t hook = 0) const;          // what a hook stands for
  bool only_creates() const { return left.nodes.empty(); }
  bool creates() const;      // some dart
  bool makes_solids() const; // of a sheet, all of which its hook stands for: it links by α3 what is free there
  bool removes() const { return !plan.removed.empty(); }
  // Darts that it adds to a map at each instance of its hook; negative: it removes more than it creates.
  int growth() const { return right.size() - left.size(); }
  // Those of stress, strain, value, across and time that its expressions ask for, each once.
  std::vector<std::string> quantities_of_law() const;
  // As the element <rule> of a preset, in a normal form: read, it makes the same rule.
  std::string print() const;

  RuleSettings settings;
  RuleGraph left, right;
  std::vector<int> before;     // node of the left graph of each node of the right one; -1: it is created
  std::vector<int> after;      // the reverse; -1: it is removed
  std::vector<int> vertex_set; // one per node of the right graph: number in `sets` of its vertex; -1: none
  std::vector<bool> joins; // one per node of the right graph: its vertex may be two before (rule_vertices.h)
  std::vector<Set> sets;
  std::vector<When> whens;
  std::vector<Where> wheres; // with the values that they have unless others are given
  std::vector<Let> lets;
  std::vector<ExpressionFunction> vocabulary; // of its expressions
  RulePlan plan;
  std::vector<RuleWarning> warnings;

private:
  void forget_places();
};

// Adds those that an expression of a rule asks for, and that are not there yet.
void add_quantities_of_law(const Expression& expression, std::vector<std::string>& out);

} // namespace rend
