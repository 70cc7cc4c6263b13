#include "sim/rules/script.h"

#include "sim/base/wording.h"
#include "sim/rules/rule_values.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {
namespace {

constexpr std::size_t most_steps = 1000;

// What a rule that stands for a part of the script blames, as the script's attribute.
SettingsSource as(const SettingsSource& source, const std::string& attribute) {
  SettingsSource out = source;
  if (source.place_of)
    out.place_of = [place = source.place_of, attribute](std::string_view asked) {
      const bool own = asked == "left" || asked == "right" || asked == "test" || asked == "name";
      return place(own ? attribute : asked);
    };
  return out;
}

[[noreturn]] void fail(const ScriptSettings& script, const SettingsSource& source, std::string_view attribute,
                       const std::string& what, const std::string& hint = {}) {
  source.fail(attribute, fmt::format("script {}: {}", in_quotes(script.name), what), hint);
}

// One node with a star, as in the left graph of a rule, and nothing else.
RuleNode node_of(const ScriptSettings& script, const SettingsSource& source, const char* attribute,
                 const std::string& text) {
  const std::string example = std::string(attribute) == "hook" ? "a*(0,1,2)" : "e*(0,1)";
  RuleGraph graph;
  try {
    graph = RuleGraph::parse(RuleSide::Left, text);
  } catch (const RuleFault& fault) {
    const std::string where = fault.column > 0 ? fmt::format(" (character {})", fault.column) : std::string();
    fail(script, source, attribute, fault.what() + where, "one node with a star, such as " + example);
  }
  const bool one = graph.size() == 1 && graph[0].hook && graph[0].position(RuleNode::dropped) < 0;
  const auto is_more = [](const RuleLink& link) { return link.kind == RuleLink::Kind::Loop; };
  if (!one || std::any_of(graph[0].links.begin(), graph[0].links.end(), is_more))
    fail(script, source, attribute,
         fmt::format("{} is not one node with a star and its orbit", in_quotes(text)),
         "such as " + example + "; conditions on its links belong into the rules that it applies");
  return graph[0];
}

std::string graph_of(const RuleNode& node, bool hook, bool label) {
  std::string out = node.name + (hook ? "*" : "");
  for (std::size_t p = 0; label && p < node.label.size(); ++p)
    out += (p == 0 ? "(" : ",") + std::to_string(node.label[p]);
  return label && !node.label.empty() ? out + ")" : out;
}

bool asks_for(const Expression& expression, const std::string& node) {
  return std::any_of(expression.calls().begin(), expression.calls().end(), [&](const ExpressionCall& call) {
    return call.name == node || (!call.names.empty() && named_dart(call.names[0]).node == node);
  });
}

Orbit orbit_of(const RuleNode& node) {
  Orbit orbit;
  for (int link : node.label) orbit.mask = static_cast<std::uint8_t>(orbit.mask | 1 << link);
  return orbit;
}

Rule scope_of(const ScriptSettings& script) {
  check_settings(script);
  RuleSettings rule{.name = script.name, .about = script.about, .whens = script.whens, .wheres = script.wheres};
  rule.source = as(script.source, "hook");
  if (!script.hook.empty()) {
    const RuleNode hook = node_of(script, script.source, "hook", script.hook);
    rule.left = graph_of(hook, true, true);
    rule.right = graph_of(hook, false, true);
  }
  return Rule(std::move(rule), "script");
}

class StepBuilder {
public:
  StepBuilder(const ScriptSettings& script, const Rule& hook, const ScriptStepSettings& settings)
      : script_(script), hook_(hook), settings_(settings) {}

  Script::Step run(const Script::Find& find) {
    check_settings(settings_);
    std::optional<RuleNode> cell;
    if (!settings_.each.empty()) cell = node_of(script_, settings_.source, "each", settings_.each);
    RuleOrScript what = find(settings_);
    const std::optional<Orbit> orbit = cell ? std::optional(orbit_of(*cell)) : std::nullopt;
    check_hook(what, orbit);
    Script::Step step{orbit, std::move(what), scope(cell), {}};
    for (const auto& [name, text] : settings_.arguments) {
      auto [number, value] = argument(step, name, text);
      const bool varies = cell && asks_for(value, cell->name);
      step.arguments.push_back({number, std::move(value), varies});
    }
    return step;
  }

private:
  [[noreturn]] void refuse(std::string_view attribute, const std::string& text,
                           const std::string& hint = {}) const {
    fail(script_, settings_.source, attribute, text, hint);
  }

  void check_hook(const RuleOrScript& what, std::optional<Orbit> cell) const {
    const std::string called = fmt::format("{} {}", what.kind(), in_quotes(what.name()));
    if (what.hooks() > 2)
      refuse("apply", fmt::format("{} has {} hooks, and a step finds the darts of two", called, what.hooks()));
    if (what.hooks() == 0 && cell)
      refuse("each", fmt::format("{} creates out of nothing, and has no hook for a cell", called),
             "leave each out: it is then applied once");
    if (what.hooks() == 0) return;
    const Orbit hook = what.hook_orbit();
    if (!cell)
      refuse("apply", fmt::format("{} has a hook, and the step has no cells for it", called),
             fmt::format("each=\"e*({})\"", links_of(hook)));
    if (what.hooks() == 1 && (hook.mask & ~cell->mask) != 0)
      refuse("apply",
             fmt::format("the hook of {} stands for {}, which is no part of a cell {}", called, to_string(hook),
                         to_string(*cell)),
             fmt::format("each=\"e*({})\" are the cells that it stands for", links_of(hook)));
  }

  static std::string links_of(Orbit orbit) {
    const std::string all = to_string(orbit); // <0,1>
    return all.substr(1, all.size() - 2);
  }

  // "a* e*": a match of it is a dart for each.
  Rule scope(const std::optional<RuleNode>& cell) const {
    RuleSettings rule{.name = script_.name, .may_fold = true, .wheres = script_.wheres};
    rule.source = as(settings_.source, "each");
    const auto add = [&](const RuleNode& node) {
      if (!rule.left.empty() && rule.right == node.name)
        refuse("each", fmt::format("{} is the name of the hook already", node.name));
      rule.left += (rule.left.empty() ? "" : " ") + graph_of(node, true, false);
      rule.right += (rule.right.empty() ? "" : " ") + node.name;
    };
    if (!hook_.left.nodes.empty()) add(hook_.left[0]);
    if (cell) add(*cell);
    for (RuleWhereSettings& where : rule.wheres) where.source = as(settings_.source, "each");
    if (!settings_.test.empty()) {
      rule.whens.push_back({.test = settings_.test});
      rule.whens.back().source = as(settings_.source, "where");
    }
    return Rule(std::move(rule), "script");
  }

  std::pair<std::size_t, Expression> argument(const Script::Step& step, const std::string& name,
                                              const std::string& text) const {
    const std::vector<Rule::Where>& known = step.what.wheres();
    std::vector<std::string> names;
    for (const Rule::Where& each : known) names.push_back(each.name);
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
      refuse(name,
             fmt::format("{} {} has no argument {}", step.what.kind(), in_quotes(step.what.name()),
                         in_quotes(name)),
             names.empty() ? "it takes none" : suggestion(name, names, "it has"));
    const auto number = static_cast<std::size_t>(found - names.begin());
    try {
      Expression made(text, step.scope.vocabulary, known[number].type);
      check_names(made, step.scope.left);
      return {number, std::move(made)};
    } catch (const ExpressionError& error) {
      refuse(name, fmt::format("{} (character {} of {})", error.flaw, error.column, in_quotes(text)),
             error.hint);
    }
  }

  const ScriptSettings& script_;
  const Rule& hook_;
  const ScriptStepSettings& settings_;
};

void add(std::vector<std::string>& to, const std::vector<std::string>& words) {
  for (const std::string& word : words)
    if (std::find(to.begin(), to.end(), word) == to.end()) to.push_back(word);
}

} // namespace

Script::Script(ScriptSettings settings_, const Find& find)
    : settings(std::move(settings_)), scope(scope_of(settings)) {
  if (settings.steps.empty())
    fail(settings, settings.source, "", "it has no steps", "<for each=\"e*(0,1)\" apply=\"NAME\"/>");
  if (settings.steps.size() > most_steps)
    fail(settings, settings.source, "", fmt::format("it has more than {} steps", most_steps));
  for (const ScriptStepSettings& step : settings.steps) {
    steps.push_back(StepBuilder(settings, scope, step).run(find));
    if (const auto& script = steps.back().what.script) {
      depth = std::max(depth, script->depth + 1);
      size += script->size;
    }
    if (size > largest)
      fail(settings, step.source, "apply",
           fmt::format("it applies more than {} scripts, counted each time", largest));
    if (depth > deepest)
      fail(settings, step.source, "apply", fmt::format("scripts apply scripts more than {} deep", deepest));
  }
  check_marks();
  settings.source = {}; // the preset need not outlive the script
  for (ScriptStepSettings& step : settings.steps) step.source = {};
  for (RuleWhenSettings& when : settings.whens) when.source = {};
  for (RuleWhereSettings& where : settings.wheres) where.source = {};
}

// Each that an expression asks for is set by a step.
void Script::check_marks() const {
  std::vector<std::string> known;
  for (const ScriptStepSettings& step : settings.steps)
    if (!step.mark.empty() && std::find(known.begin(), known.end(), step.mark) == known.end())
      known.push_back(step.mark);
  if (known.size() > RuleMarks::most)
    fail(settings, settings.source, "", fmt::format("it has more than {} marks", RuleMarks::most));
  const auto check = [&](const Expression& expression, const SettingsSource& source,
                         std::string_view attribute) {
    for (const ExpressionCall& call : expression.calls())
      if (call.function == static_cast<std::size_t>(RuleFunction::Marked) &&
          std::find(known.begin(), known.end(), call.names[1]) == known.end())
        fail(settings, source, attribute, fmt::format("no step sets the mark {}", in_quotes(call.names[1])),
             known.empty() ? "<for each=\"...\" apply=\"...\" mark=\"" + call.names[1] + "\"/>"
                           : suggestion(call.names[1], known, "there are"));
  };
  for (std::size_t n = 0; n < steps.size(); ++n) {
    for (const Rule::When& when : steps[n].scope.whens) check(when.test, settings.steps[n].source, "where");
    for (const Argument& argument : steps[n].arguments)
      check(argument.value, settings.steps[n].source, steps[n].what.wheres()[argument.number].name);
  }
}

std::vector<std::string> Script::quantities_of_law() const {
  std::vector<std::string> out = scope.quantities_of_law();
  for (const Step& step : steps) {
    add(out, step.scope.quantities_of_law());
    for (const Argument& argument : step.arguments) add_quantities_of_law(argument.value, out);
    add(out, step.what.quantities_of_law());
  }
  return out;
}

bool Script::fits_sheets() const {
  return std::all_of(steps.begin(), steps.end(), [](const Step& step) { return step.what.fits_sheets(); });
}

bool Script::grows() const {
  return std::any_of(steps.begin(), steps.end(), [](const Step& step) { return step.what.grows(); });
}

const std::string& RuleOrScript::name() const {
  return rule ? rule->settings.name : script->settings.name;
}
const std::string& RuleOrScript::about() const {
  return rule ? rule->settings.about : script->settings.about;
}
std::size_t RuleOrScript::hooks() const {
  return rule ? rule->plan.hooks.size() : script->has_hook() ? 1 : 0;
}
Orbit RuleOrScript::hook_orbit() const {
  return rule ? rule->hook_orbit() : script->hook_orbit();
}
const std::vector<Rule::Where>& RuleOrScript::wheres() const {
  return rule ? rule->wheres : script->scope.wheres;
}
std::vector<std::string> RuleOrScript::quantities_of_law() const {
  return rule ? rule->quantities_of_law() : script->quantities_of_law();
}
bool RuleOrScript::fits_sheets() const {
  return rule ? !rule->plan.needs_volumes : script->fits_sheets();
}
bool RuleOrScript::grows() const {
  return rule ? rule->creates() || !rule->plan.links.empty() || !rule->sets.empty() : script->grows();
}
std::string RuleOrScript::print() const {
  return rule ? rule->print() : script->print();
}

} // namespace rend
