// Random scripts that are legal: steps of house rules, of random rules and of scripts made before, over random
// orbits, of which those are kept that are accepted.
#pragma once

#include "sim/rules/script.h"
#include "tests/sim/rules/random_rules.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rend::random_scripts {

class Generator {
public:
  explicit Generator(unsigned seed) : random_(seed), rules_(seed + 1) {}

  std::shared_ptr<const Script> next() {
    for (;; ++refused) {
      auto script = attempt();
      if (!script) continue;
      made_.push_back(script);
      if (made_.size() > 20) made_.erase(made_.begin());
      return script;
    }
  }
  std::size_t refused = 0;

private:
  std::size_t below(std::size_t n) { return random_() % n; }

  // At most so many darts there are for each one after it, if it is applied at every dart: they must not become
  // too many.
  static double growth(const RuleOrScript& what) {
    double times = 1;
    if (what.rule)
      for (int before : what.rule->before) times += before < 0;
    else
      for (const Script::Step& step : what.script->steps) times *= growth(step.what);
    return times;
  }

  std::string orbit() {
    std::string out;
    const std::size_t mask =
        below(3) == 0 ? below(16) : std::array<std::size_t, 6>{3, 5, 6, 7, 14, 15}[below(6)];
    for (int i = 0; i < 4; ++i)
      if (mask >> i & 1) out += (out.empty() ? "" : ",") + std::to_string(i);
    return out;
  }

  RuleOrScript what() {
    if (!made_.empty() && below(6) == 0) return made_[below(made_.size())];
    if (below(3) == 0) return std::make_shared<const Rule>(rules_.next());
    const Rule& house = house_rules()[below(house_rules().size())];
    return std::shared_ptr<const Rule>(std::shared_ptr<const Rule>(), &house);
  }

  // Of the hook's orbit or, mostly, what the rule's hook stands for.
  std::string cell(const RuleOrScript& of) {
    if (of.hooks() == 0) return below(8) == 0 ? "e*(0)" : "";
    if (of.hooks() == 2) return below(2) == 0 ? "e*(2,3)" : "e*(1,2)"; // all pairs of darts are tried
    if (below(4) == 0) return "e*(" + orbit() + ")";
    const std::string links = to_string(of.hook_orbit());
    return "e*(" + links.substr(1, links.size() - 2) + ")";
  }

  std::shared_ptr<const Script> attempt() {
    ScriptSettings script{.name = "random"};
    if (below(20) > 0) script.hook = "a*(" + orbit() + ")";
    static constexpr const char* tests[] = {
        "length(e) > 0.7",        "free(e, 2)",
        "size(e, face) < 5",      "x(mean(e, face)) > x(mean(a, component))",
        "size(a, component) > 6", "1/(size(e, edge) - 2) > 0"};
    std::vector<RuleOrScript> all;
    for (std::size_t n = 1 + below(4); n > 0; --n) {
      all.push_back(what());
      ScriptStepSettings step{.each = cell(all.back()), .apply = std::to_string(all.size() - 1)};
      if (below(3) == 0) step.test = tests[below(6)];
      step.at = static_cast<RuleWhenSettings::At>(below(3));
      step.which = static_cast<ScriptStepSettings::Which>(below(3));
      step.at_least = static_cast<ScriptStepSettings::AtLeast>(below(3));
      for (const Rule::Where& where : all.back().wheres())
        if (below(2) == 0)
          step.arguments[where.name] = where.type == ValueType::Scalar ? "length(e)" : "e - mean(a, component)";
      script.steps.push_back(step);
    }
    if (below(6) == 0) script.whens.push_back({.test = "size(a, face) > 3", .otherwise = "few"});
    try {
      auto made = std::make_shared<const Script>(script, [&](const ScriptStepSettings& step) {
        return all[static_cast<std::size_t>(std::stoi(step.apply))];
      });
      return made->depth > 3 || growth(std::shared_ptr<const Script>(made)) > 60 ? nullptr : made;
    } catch (const UserError&) {
      return nullptr;
    }
  }

  std::mt19937 random_;
  random_rules::Generator rules_;
  std::vector<std::shared_ptr<const Script>> made_;
};

} // namespace rend::random_scripts
