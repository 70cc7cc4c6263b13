#include "sim/rules/rule.h"

#include "sim/base/wording.h"
#include "sim/expression/functions.h"
#include "sim/rules/rule_check.h"
#include "sim/rules/rule_plan.h"
#include "sim/rules/rule_values.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {

using Kind = RuleLink::Kind;

namespace {

constexpr std::size_t most_parts = 1000; // <set>, <when>, <where> of a rule

// Of two values of one expression: the same but for rounding.
bool same(const Value& a, const Value& b) {
  for (std::size_t n = 0; n < 3; ++n) {
    const double size = std::max({1.0, std::abs(a.number[n]), std::abs(b.number[n])});
    if (!(std::abs(a.number[n] - b.number[n]) <= 1e-9 * size)) return false;
  }
  return true;
}

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
    vertices();
    for (const RuleWhenSettings& when : settings_.whens) add(when);
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

  Expression expression(const SettingsSource& source, const char* attribute, const std::string& text,
                        ValueType wanted) const {
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
    if (settings_.wheres.size() + settings_.sets.size() + settings_.whens.size() > most_parts)
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
        fail(where.source, "value", error.flaw, error.hint);
      }
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
    return name == "and" || name == "or" || name == "not" || has_it(rule_vocabulary({}, {})) ||
           std::any_of(built_ins().begin(), built_ins().end(),
                       [&](const BuiltIn& each) { return each.declared.name == name; });
  }

  // The names of nodes and arguments are variables of expressions.
  std::vector<ExpressionFunction> vocabulary() const {
    constexpr const char* hint = "take another name";
    for (const RuleNode& node : rule_.left.nodes)
      if (is_taken(node.name))
        fail(settings_.source, "left",
             fmt::format("{} is a function of expressions, and no name of a node", node.name), hint);
    std::vector<std::string> names;
    for (const RuleWhereSettings& where : settings_.wheres) {
      names.push_back(where.name);
      if (is_taken(where.name))
        fail(where.source, "name", fmt::format("{} is a function of expressions", where.name), hint);
      if (!is_word(where.name))
        fail(where.source, "name", fmt::format("{} is no name", in_quotes(where.name)),
             "a letter, then letters, digits and _");
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
      if (kept) continue;
      if (chosen < 0 || !rule_.sets[static_cast<std::size_t>(chosen)].position)
        fail(settings_.source, "right",
             fmt::format("the new vertex of node {} has no position", rule_.right[n].name),
             fmt::format("<set node=\"{}\" position=\"mean({}, face)\"/>", rule_.right[n].name,
                         rule_.left.nodes.empty() ? "a" : rule_.left[0].name));
    }
    for (std::size_t s = 0; s < rule_.sets.size(); ++s) check_symmetry(s);
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
  // the same. Asked with numbers: calls that keep their value at that neighbour get the same ones there,
  // others do not.
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
        if (*expression && !symmetric(**expression, static_cast<int>(p)))
          fail(settings_.sets[s].source, attribute,
               fmt::format(
                   "{} is not the same at all darts of the vertex of node {}: the hook's α{} leads from one "
                   "to the other",
                   in_quotes((*expression)->text()), rule_.right[set.node].name,
                   rule_.left[rule_.plan.hooks[0]].label[p]),
               "mean(a, edge), mean(a, face) ... are the same for all darts of the edge, the face");
    }
  }

  bool symmetric(const Expression& expression, int p) const {
    for (unsigned seed = 1; seed <= 3; ++seed) {
      const auto at = [&](unsigned instance) {
        return expression.evaluate(
            [&](const ExpressionCall& call, std::size_t, std::span<const Value> arguments) {
              return made_up(call, arguments, seed, keeps_value(call, rule_.left, p) ? 0 : instance);
            });
      };
      try {
        if (!same(at(0), at(1))) return false;
      } catch (const ExpressionError&) { // at these numbers it has no value; at others it may
      }
    }
    return true;
  }

  // A value of a call that hangs on what is called, and on `seed` and `instance`.
  Value made_up(const ExpressionCall& call, std::span<const Value> arguments, unsigned seed,
                unsigned instance) const {
    if (call.function == static_cast<std::size_t>(RuleFunction::Lerp)) {
      const double t = arguments[2].scalar();
      const auto mixed = [&](std::size_t n) {
        return (1 - t) * arguments[0].number[n] + t * arguments[1].number[n];
      };
      return vector_value(mixed(0), mixed(1), mixed(2));
    }
    std::uint64_t hash = 0x9e3779b97f4a7c15u * (call.function + 1) + 1000003u * seed + 7919u * instance;
    for (const std::string& name : call.names)
      for (char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    const auto number = [&] {
      hash ^= hash >> 29;
      hash *= 0xbf58476d1ce4e5b9u;
      hash ^= hash >> 32;
      return 0.5 + static_cast<double>(hash >> 12) / static_cast<double>(1ull << 52);
    };
    if (rule_.vocabulary[call.function].result == ValueType::Scalar) return scalar_value(number());
    const double x = number(), y = number();
    return vector_value(x, y, number());
  }

  void add(const RuleWhenSettings& when) {
    check_settings(when);
    if (rule_.only_creates()) fail(when.source, "test", "a rule without a left graph has nothing to test");
    rule_.whens.push_back(
        {expression(when.source, "test", when.test, ValueType::Condition), when.at, when.otherwise});
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
  return out;
}

void add_quantities_of_law(const Expression& expression, std::vector<std::string>& out) {
  for (const ExpressionCall& call : expression.calls())
    if (call.function >= static_cast<std::size_t>(RuleFunction::Stress) && call.function < rule_functions &&
        std::find(out.begin(), out.end(), call.name) == out.end())
      out.push_back(call.name);
}

bool Rule::creates() const {
  return std::find(before.begin(), before.end(), -1) != before.end();
}

} // namespace rend
