#include "sim/rules/rule.h"

#include "sim/base/wording.h"
#include "sim/expression/functions.h"
#include "sim/rules/rule_check.h"
#include "sim/rules/rule_plan.h"
#include "sim/rules/rule_symmetry.h"
#include "sim/rules/rule_vertices.h"
#include "sim/rules/rule_vocabulary.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {

using Kind = RuleLink::Kind;

namespace {

constexpr std::size_t most_parts = 1000; // <set>, <when>, <where> of a rule

class Builder {
public:
  Builder(Rule& rule, const char* kind) : rule_(rule), settings_(rule.settings), kind_(kind) {}

  void run() {
    check_settings(settings_);
    graphs();
    pair_nodes();
    rule_.plan = make_plan(rule_.left, rule_.right, rule_.before, rule_.after);
    wheres();
    rule_.vocabulary = vocabulary();
    for (const RuleLetSettings& let : settings_.lets) add(let);
    vertices();
    for (const RuleWhenSettings& when : settings_.whens) add(when);
    for (int n = 0; n < rule_.right.size(); ++n) warn_of_open_cells(rule_.right[n]);
  }

private:
  void graphs() {
    try {
      rule_.left = RuleGraph::parse(RuleSide::Left, settings_.left);
      rule_.right = RuleGraph::parse(RuleSide::Right, settings_.right);
      check_graphs(rule_.left, rule_.right, settings_.may_fold);
    } catch (const RuleFault& fault) {
      const std::string where = fault.column > 0
                                    ? fmt::format(" (character {} of {})", fault.column, name_of(fault.side))
                                    : std::string();
      settings_.source.fail(name_of(fault.side),
                            fmt::format("{} {}: {}{}", kind_, in_quotes(rule_.name()), fault.what(), where),
                            fault.hint);
    }
  }

  void pair_nodes() {
    for (const RuleNode& node : rule_.right.nodes) rule_.before.push_back(rule_.left.find(node.name));
    for (const RuleNode& node : rule_.left.nodes) rule_.after.push_back(rule_.right.find(node.name));
  }

  [[noreturn]] void fail(const SettingsSource& source, std::string_view attribute, const std::string& what,
                         const std::string& hint = {}) const {
    source.fail(attribute, fmt::format("{} {}: {}", kind_, in_quotes(rule_.name()), what), hint);
  }

  // `wanted`: nullopt: whatever type it has.
  Expression expression(const SettingsSource& source, const char* attribute, const std::string& text,
                        std::optional<ValueType> wanted) const {
    try {
      Expression made(text, rule_.vocabulary, wanted);
      check_names(made, rule_.left);
      return made;
    } catch (const ExpressionError& error) {
      fail(source, attribute, fmt::format("{} (character {} of {})", error.flaw, error.column, in_quotes(text)),
           error.hint);
    }
  }

  // Arguments are numbers or points: what their default is.
  void wheres() {
    if (settings_.wheres.size() + settings_.sets.size() + settings_.whens.size() + settings_.lets.size() >
        most_parts)
      fail(settings_.source, "", fmt::format("there are more than {} expressions", most_parts));
    for (const RuleWhereSettings& where : settings_.wheres) {
      check_settings(where);
      for (const Rule::Where& other : rule_.wheres)
        if (other.name == where.name)
          fail(where.source, "name", fmt::format("two arguments are called {}", in_quotes(where.name)));
      if (rule_.left.find(where.name) >= 0)
        fail(where.source, "name", fmt::format("{} is a node's name already", in_quotes(where.name)));
      try {
        const Expression value = constant(where.value);
        rule_.wheres.push_back({where.name, value.type(), value.evaluate()});
      } catch (const ExpressionError& error) {
        if (speaks_of_nodes(where.value))
          fail(where.source, "value",
               fmt::format("a <where> knows no nodes, and {} speaks of one", in_quotes(where.value)),
               fmt::format("<let name=\"{}\" value=\"{}\"/> may: it has its value at each dart", where.name,
                           where.value));
        fail(where.source, "value", error.flaw, error.hint);
      }
    }
  }

  bool speaks_of_nodes(const std::string& text) const {
    try {
      const Expression expression(text, rule_vocabulary(rule_.left, {}), std::nullopt);
      check_names(expression, rule_.left);
      return !expression.constant();
    } catch (const ExpressionError&) {
      return false;
    }
  }

  static Expression constant(const std::string& text) {
    try {
      return Expression(text, {}, ValueType::Scalar);
    } catch (const ExpressionError& of_scalar) {
      try {
        return Expression(text, {}, ValueType::Vector);
      } catch (const ExpressionError&) {
        throw of_scalar;
      }
    }
  }

  static bool is_word(const std::string& name) {
    const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    const auto later = [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '_'; };
    return !name.empty() && letter(name[0]) && std::all_of(name.begin(), name.end(), later);
  }
  static bool is_taken(const std::string& name) {
    const auto has_it = [&](const std::vector<ExpressionFunction>& functions) {
      return std::any_of(functions.begin(), functions.end(),
                         [&](const auto& each) { return each.name == name; });
    };
    return name == "and" || name == "or" || name == "not" || name == "if" || has_it(rule_vocabulary({}, {})) ||
           std::any_of(built_ins().begin(), built_ins().end(),
                       [&](const BuiltIn& each) { return each.declared.name == name; });
  }

  void check_name(const std::string& name, const SettingsSource& source) const {
    if (is_taken(name))
      fail(source, "name", fmt::format("{} is a function of expressions", name), "take another name");
    if (!is_word(name))
      fail(source, "name", fmt::format("{} is no name", in_quotes(name)),
           "a letter, then letters, digits and _");
  }

  // Those of earlier ones, and all that the rule's other expressions know, may stand in its value.
  void add(const RuleLetSettings& let) {
    check_settings(let);
    check_name(let.name, let.source);
    for (const ExpressionFunction& known : rule_.vocabulary)
      if (known.name == let.name)
        fail(let.source, "name", fmt::format("{} is the name of something else already", in_quotes(let.name)),
             "each node, argument and let has its own");
    Expression value = expression(let.source, "value", let.value, std::nullopt);
    int depth = 1;
    for (const ExpressionCall& call : value.calls())
      if (const Rule::Let* other = rule_.find_let(call)) depth = std::max(depth, other->depth + 1);
    if (depth > Rule::Let::deepest)
      fail(let.source, "value", fmt::format("lets use lets more than {} deep", Rule::Let::deepest));
    rule_.vocabulary.push_back({let.name, {}, value.type(), "a let of the rule"});
    rule_.lets.push_back({let.name, std::move(value), depth});
  }

  // The names of nodes and arguments are variables of expressions.
  std::vector<ExpressionFunction> vocabulary() const {
    for (const RuleNode& node : rule_.left.nodes)
      if (is_taken(node.name))
        fail(settings_.source, "left",
             fmt::format("{} is a function of expressions, and no name of a node", node.name),
             "take another name");
    std::vector<std::string> names;
    for (const RuleWhereSettings& where : settings_.wheres) {
      names.push_back(where.name);
      check_name(where.name, where.source);
    }
    std::vector<ExpressionFunction> all = rule_vocabulary(rule_.left, names);
    for (std::size_t n = 0; n < rule_.wheres.size(); ++n)
      all[rule_functions + rule_.left.nodes.size() + n].result = rule_.wheres[n].type;
    return all;
  }

  // One value an orbit: a new vertex has a position, and no vertex has two.
  void vertices() {
    for (const RuleSetSettings& set : settings_.sets) add(set);
    rule_.vertex_set.assign(rule_.right.nodes.size(), -1);
    const VertexJoins joins(rule_.left, rule_.right, rule_.before);
    for (int n = 0; n < rule_.right.size(); ++n) {
      const std::vector<bool> vertex = rule_.right.reach(n, Vertex);
      bool kept = false;
      int& chosen = rule_.vertex_set[static_cast<std::size_t>(n)];
      for (int m = 0; m < rule_.right.size(); ++m)
        kept = kept || (vertex[static_cast<std::size_t>(m)] && rule_.before[static_cast<std::size_t>(m)] >= 0);
      for (std::size_t s = 0; s < rule_.sets.size(); ++s) {
        if (!vertex[static_cast<std::size_t>(rule_.sets[s].node)]) continue;
        if (chosen >= 0)
          fail(settings_.sets[s].source, "node",
               fmt::format("the vertex of node {} is set twice", rule_.right[rule_.sets[s].node].name),
               "one <set> for each vertex");
        chosen = static_cast<int>(s);
      }
      const std::optional<VertexJoin> join = kept ? joins.at(n) : std::nullopt;
      rule_.joins.push_back(join.has_value());
      if (join && (chosen < 0 || !rule_.sets[static_cast<std::size_t>(chosen)].position)) refuse(*join, n);
      if (kept) continue;
      if (chosen < 0 || !rule_.sets[static_cast<std::size_t>(chosen)].position)
        fail(settings_.source, "right",
             fmt::format("the new vertex of node {} has no position", rule_.right[n].name),
             fmt::format("<set node=\"{}\" position=\"mean({}, face)\"/>", rule_.right[n].name,
                         rule_.left.nodes.empty() ? "a" : rule_.left[0].name));
    }
    for (std::size_t s = 0; s < rule_.sets.size(); ++s) check_symmetry(s);
  }

  [[noreturn]] void refuse(const VertexJoin& join, int node) const {
    const std::string &first = rule_.left[join.first].name, &second = rule_.left[join.second].name,
                      &set = rule_.right[node].name;
    if (join.position < 0)
      fail(settings_.source, "right",
           fmt::format(
               "nodes {} and {} are of two vertices on the left and of one on the right, and no <set> says "
               "where that is",
               first, second),
           fmt::format("<set node=\"{}\" position=\"{}\"/> is where that of {} was, lerp({}, {}, 0.5) halfway",
                       set, second, second, first, second));
    const RuleNode& hook = rule_.left[rule_.plan.hooks[0]];
    const int link = hook.label[static_cast<std::size_t>(join.position)];
    const char* const orbits[] = {"edge", "face", "volume", "component"};
    fail(settings_.source, "right",
         fmt::format(
             "the vertices of node {} at both ends of the hook's α{} become one, and no <set> says where "
             "that is",
             first, link),
         fmt::format("<set node=\"{}\" position=\"mean({}, {})\"/>", set, hook.name,
                     orbits[static_cast<std::size_t>(link)]));
  }

  void add(const RuleSetSettings& set) {
    check_settings(set);
    const int node = rule_.right.find(set.node);
    std::vector<std::string> names;
    for (const RuleNode& each : rule_.right.nodes) names.push_back(each.name);
    if (node < 0)
      fail(set.source, "node", fmt::format("the right graph has no node {}", in_quotes(set.node)),
           suggestion(set.node, names, "its nodes"));
    if (set.position.empty() && set.rest.empty() && set.velocity.empty())
      fail(set.source, "", "<set> sets nothing", "position=\"mean(a, face)\"");
    Rule::Set made;
    made.node = node;
    const auto take = [&](const char* attribute, const std::string& text, std::optional<Expression>& to) {
      if (!text.empty()) to = expression(set.source, attribute, text, ValueType::Vector);
    };
    take("position", set.position, made.position);
    take("rest", set.rest, made.rest);
    take("velocity", set.velocity, made.velocity);
    rule_.sets.push_back(std::move(made));
  }

  // The vertex of a node stretches over several instances where a label leads to it: there the value must be
  // the same (rule_symmetry.h).
  void check_symmetry(std::size_t s) {
    const Rule::Set& set = rule_.sets[s];
    const std::vector<bool> vertex = rule_.right.reach(set.node, Vertex);
    const std::size_t positions = rule_.plan.hooks.empty() ? 0 : rule_.left[rule_.plan.hooks[0]].label.size();
    for (std::size_t p = 0; p < positions; ++p) {
      bool leads = false;
      for (int m = 0; m < rule_.right.size(); ++m) {
        const int link = rule_.right[m].label[p];
        leads = leads || (vertex[static_cast<std::size_t>(m)] && link >= 1 && link <= 3);
      }
      if (!leads) continue;
      for (const auto& [attribute, expression] :
           {std::pair{"position", &set.position}, {"rest", &set.rest}, {"velocity", &set.velocity}})
        if (*expression && !is_symmetric(rule_, **expression, static_cast<int>(p)))
          fail(settings_.sets[s].source, attribute,
               fmt::format(
                   "{} is not the same at all darts of the vertex of node {}: the hook's α{} leads from one "
                   "to the other",
                   in_quotes((*expression)->text()), rule_.right[set.node].name,
                   rule_.left[rule_.plan.hooks[0]].label[p]),
               "mean(a, edge), mean(a, face) ... are the same for all darts of the edge, the face");
    }
  }

  void add(const RuleWhenSettings& when) {
    check_settings(when);
    if (rule_.only_creates()) fail(when.source, "test", "a rule without a left graph has nothing to test");
    rule_.whens.push_back(
        {expression(when.source, "test", when.test, ValueType::Condition), when.at, when.otherwise});
  }

  // At the border of a sheet α2 is free, and on the hull of a solid α3: a link that it becomes is free there,
  // too.
  void warn_of_open_cells(const RuleNode& node) {
    for (std::size_t p = 0; p < node.label.size(); ++p) {
      const int is = node.label[p], was = rule_.left[rule_.plan.hooks[0]].label[p];
      const bool sheet = was == 2 && !rule_.plan.needs_volumes;
      if (is == RuleNode::dropped || is >= was || !(sheet || was == 3) || is_asked_at_all_darts()) continue;
      const std::string hook = rule_.left[rule_.plan.hooks[0]].name;
      rule_.warnings.push_back(
          {settings_.source.place("right"),
           fmt::format("{} {}: {}, α{} of the hook is free, and with it α{} of node {}: {} is open there",
                       kind_, in_quotes(rule_.name()),
                       sheet ? "at the border of a sheet" : "on the hull of a solid", was, is, node.name,
                       is == 2 ? "a volume" : "a face"),
           fmt::format("<when test=\"not free({}, {})\" at=\"all\"/> keeps it away from there", hook, was)});
      return; // of one node, once
    }
  }

  // Whether a <when at="all"> asks which links are free.
  bool is_asked_at_all_darts() const {
    return std::any_of(rule_.whens.begin(), rule_.whens.end(), [](const Rule::When& when) {
      return when.at == RuleWhenSettings::At::All &&
             std::any_of(when.test.calls().begin(), when.test.calls().end(), [](const ExpressionCall& call) {
               return call.function == static_cast<std::size_t>(RuleFunction::Free);
             });
    });
  }

  Rule& rule_;
  const RuleSettings& settings_;
  const char* kind_;
};

} // namespace

Rule::Rule(RuleSettings settings_, const char* kind) : settings(std::move(settings_)) {
  Builder(*this, kind).run();
  forget_places(); // the preset need not outlive the rule
}

void Rule::forget_places() {
  settings.source = {};
  for (RuleSetSettings& set : settings.sets) set.source = {};
  for (RuleWhenSettings& when : settings.whens) when.source = {};
  for (RuleWhereSettings& where : settings.wheres) where.source = {};
  for (RuleLetSettings& let : settings.lets) let.source = {};
}

const Rule::Let* Rule::find_let(const ExpressionCall& call) const {
  const std::size_t first = rule_functions + left.nodes.size() + wheres.size();
  return call.function < first ? nullptr : &lets[call.function - first];
}

Orbit Rule::hook_orbit(std::size_t hook) const {
  Orbit orbit;
  for (int link : left[plan.hooks[hook]].label) orbit.mask = static_cast<std::uint8_t>(orbit.mask | 1 << link);
  return orbit;
}

std::vector<std::string> Rule::quantities_of_law() const {
  std::vector<std::string> out;
  for (const Set& set : sets)
    for (const auto* each : {&set.position, &set.rest, &set.velocity})
      if (*each) add_quantities_of_law(**each, out);
  for (const When& when : whens) add_quantities_of_law(when.test, out);
  for (const Let& let : lets) add_quantities_of_law(let.value, out);
  return out;
}

void add_quantities_of_law(const Expression& expression, std::vector<std::string>& out) {
  for (const ExpressionCall& call : expression.calls())
    if (call.function >= static_cast<std::size_t>(RuleFunction::Stress) && call.function < rule_functions &&
        std::find(out.begin(), out.end(), call.name) == out.end())
      out.push_back(call.name);
}

bool Rule::makes_solids() const {
  if (plan.hooks.size() != 1 || !plan.links_volumes || hook_orbit() != Orbit{0, 1, 2}) return false;
  return left.link(plan.hooks[0], 3).kind == Kind::Loop;
}

bool Rule::creates() const {
  return std::find(before.begin(), before.end(), -1) != before.end();
}

} // namespace rend
