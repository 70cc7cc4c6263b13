#include "render/facts/rule_facts.h"

#include "sim/base/printable.h"
#include "sim/base/wording.h"
#include "sim/rules/cell_words.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace rend {
namespace {

// Of a script: those of its hook.
RuleFacts facts_of_left(const Rule& rule, const std::string& from) {
  RuleFacts facts{.name = rule.name(), .about = rule.settings.about, .from = from};
  for (std::size_t n = 0; n < rule.plan.hooks.size(); ++n) {
    const Orbit orbit = rule.hook_orbit(n);
    facts.hooks.push_back({rule.left[rule.plan.hooks[n]].name, to_string(orbit), cell_in_words(orbit)});
  }
  for (const RuleWhereSettings& where : rule.settings.wheres)
    facts.arguments.push_back({where.name, where.value});
  return facts;
}

std::string list_or(const std::vector<std::string>& names, const char* none) {
  return names.empty() ? none : listed(names);
}

std::string hooks_in_words(const RuleFacts& facts, bool with_nodes) {
  std::vector<std::string> words;
  for (const RuleFacts::Hook& hook : facts.hooks)
    words.push_back((with_nodes ? hook.node + ": " : "") + hook.orbit + " " + hook.cell);
  if (words.empty()) return with_nodes ? "none: it only creates" : "-";
  if (!with_nodes && words.size() > 1 && words.front() == words.back())
    return fmt::format("{} x {}", words.size(), words.front());
  std::string out;
  for (const std::string& each : words) out += (out.empty() ? "" : with_nodes ? "; " : " + ") + each;
  return out;
}

} // namespace

RuleFacts rule_facts(const Rule& rule, const std::string& from) {
  RuleFacts facts = facts_of_left(rule, from);
  for (const RuleNode& node : rule.right.nodes)
    (rule.left.find(node.name) < 0 ? facts.creates : facts.keeps).push_back(node.name);
  for (const RuleNode& node : rule.left.nodes)
    if (rule.right.find(node.name) < 0) facts.removes.push_back(node.name);
  facts.fits_sheets = !rule.plan.needs_volumes;
  facts.folds = rule.settings.may_fold;
  if (const auto quantities = rule.quantities_of_law(); !quantities.empty()) facts.asks_for = quantities[0];
  facts.text = rule.print();
  return facts;
}

RuleFacts rule_facts(const Script& script, const std::string& from) {
  RuleFacts facts = facts_of_left(script.scope, from);
  facts.script = true;
  facts.fits_sheets = script.fits_sheets();
  for (const Script::Step& step : script.steps)
    if (std::find(facts.applies.begin(), facts.applies.end(), step.what.name()) == facts.applies.end())
      facts.applies.push_back(step.what.name());
  if (const auto quantities = script.quantities_of_law(); !quantities.empty()) facts.asks_for = quantities[0];
  facts.text = script.print();
  return facts;
}

RuleFacts rule_facts(const RuleOrScript& what, const std::string& from) {
  return what.rule ? rule_facts(*what.rule, from) : rule_facts(*what.script, from);
}

nlohmann::ordered_json json_of(const RuleFacts& facts) {
  nlohmann::ordered_json hooks = nlohmann::ordered_json::array(), arguments = nlohmann::ordered_json::object();
  for (const RuleFacts::Hook& hook : facts.hooks)
    hooks.push_back({{"node", hook.node}, {"orbit", hook.orbit}, {"cell", hook.cell}});
  for (const RuleFacts::Argument& argument : facts.arguments) arguments[argument.name] = argument.value;
  nlohmann::ordered_json out{{"name", facts.name},
                             {"about", facts.about},
                             {"from", facts.from},
                             {"hooks", hooks},
                             {"arguments", arguments}};
  if (facts.script) {
    out["applies"] = facts.applies;
  } else {
    out["creates"] = facts.creates;
    out["keeps"] = facts.keeps;
    out["removes"] = facts.removes;
  }
  out["sheets"] = facts.fits_sheets;
  out["solids"] = true;
  if (!facts.script) out["may_fold"] = facts.folds;
  if (!facts.asks_for.empty()) out["asks_for"] = facts.asks_for;
  out[facts.script ? "script" : "rule"] = facts.text;
  return out;
}

std::string facts_in_words(const RuleFacts& facts) {
  std::string out = printable(facts.name) + (facts.about.empty() ? "" : ": " + printable(facts.about)) +
                    "\n\n" + printable_lines(facts.text) + "\n";
  const auto row = [&](const char* what, const std::string& words) {
    out += fmt::format("{:<11}{}\n", what, printable(words));
  };
  std::vector<std::string> arguments;
  for (const RuleFacts::Argument& argument : facts.arguments)
    arguments.push_back(argument.name + " = " + argument.value);
  row("hook", hooks_in_words(facts, true));
  row("arguments", list_or(arguments, "none"));
  if (facts.script) {
    row("applies", listed(facts.applies));
  } else {
    row("keeps", list_or(facts.keeps, "nothing"));
    row("creates", list_or(facts.creates, "nothing"));
    row("removes", list_or(facts.removes, "nothing"));
  }
  row("fits", facts.fits_sheets ? "sheets and solids" : "solids");
  if (facts.folds) row("may fold", "it also matches where darts of the left graph coincide");
  if (!facts.asks_for.empty()) row("asks for", facts.asks_for + ", which laws of tearing alone know");
  if (facts.from != "built-in") row("from", facts.from);
  return out;
}

std::string list_in_words(const std::vector<RuleFacts>& all) {
  std::size_t name = 0, hooks = 0;
  for (const RuleFacts& facts : all) {
    name = std::max(name, printable(facts.name).size());
    hooks = std::max(hooks, hooks_in_words(facts, false).size());
  }
  std::string out;
  for (const RuleFacts& facts : all)
    out += fmt::format("{:<{}}  {:<{}}  {}\n", printable(facts.name), name, hooks_in_words(facts, false), hooks,
                       printable(facts.about));
  return out;
}

} // namespace rend
