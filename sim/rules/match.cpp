#include "sim/rules/match.h"

#include "sim/base/check.h"
#include "sim/rules/map_budget.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {

using Kind = RuleLink::Kind;

Hooks::Hooks(std::initializer_list<Dart> darts) {
  CHECK(darts.size() <= darts_.size());
  for (Dart d : darts) darts_[count_++] = d;
}

std::string Mismatch::sentence(const Rule& rule) const {
  const auto node_name = [&] { return node < 0 ? std::string() : rule.left[node].name; };
  switch (kind) {
  case Kind::None:
    return {};
  case Kind::NoDart:
    return fmt::format("there is no dart {}", dart.value);
  case Kind::SheetWithoutVolumes:
    return "a sheet has no volumes to link";
  case Kind::NotFree:
    return fmt::format("node {}: dart {} should be α{}-free, and is linked to {}", node_name(), dart.value,
                       link, is.value);
  case Kind::Free:
    return fmt::format("node {}: dart {} is α{}-free, and the rule needs a neighbour there", node_name(),
                       dart.value, link);
  case Kind::OtherDart:
    return fmt::format("node {}: α{} of dart {} should be {}, and is {}", node_name(), link, dart.value,
                       wanted.value, is.value);
  case Kind::NotIsomorphic:
    return fmt::format("the orbits of the hooks are not isomorphic: they part at dart {}", dart.value);
  case Kind::Twice:
    return fmt::format("dart {} would have to play two parts, and the rule may not fold", dart.value);
  case Kind::Condition: {
    const Rule::When& when = rule.whens[static_cast<std::size_t>(link)];
    return when.otherwise.empty() ? fmt::format("\"{}\" does not hold", when.test.text()) : when.otherwise;
  }
  case Kind::Expression:
  case Kind::Shape:
  case Kind::Budget:
    return text;
  }
  return {};
}

std::string Mismatch::in_general(const Rule& rule) const {
  const auto of_node = [&] { return node < 0 ? std::string() : "node " + rule.left[node].name + ": "; };
  switch (kind) {
  case Kind::NoDart:
    return "its dart is gone";
  case Kind::NotFree:
    return fmt::format("{}α{} is linked, and should be free", of_node(), link);
  case Kind::Free:
    return fmt::format("{}α{} is free, and the rule needs a neighbour there", of_node(), link);
  case Kind::OtherDart:
    return fmt::format("{}α{} leads to another dart than the rule asks for", of_node(), link);
  case Kind::NotIsomorphic:
    return "the orbits of the hooks are not isomorphic";
  case Kind::Twice:
    return "a dart would have to play two parts, and the rule may not fold";
  case Kind::Expression:
  case Kind::Shape:
    return text.substr(0, std::min(text.find(", near "), text.find(" at dart ")));
  case Kind::Budget:
    return beyond_budget;
  case Kind::None:
  case Kind::SheetWithoutVolumes:
  case Kind::Condition:
    break;
  }
  return sentence(rule);
}

namespace {

// The instance of each dart of the hook's orbit: a list while there are few, a table from then on.
class Instances {
public:
  void clear() {
    count_ = 0;
    in_table_ = false;
  }
  // The instance of d; `next` if it is new.
  std::uint32_t insert(Dart d, std::uint32_t next) {
    if (in_table_) return table_.insert(d.value, next);
    for (std::uint32_t n = 0; n < count_; ++n)
      if (few_[n] == d.value) return n;
    if (count_ < few_.size()) {
      few_[count_++] = d.value;
      return next;
    }
    table_.clear();
    for (std::uint32_t n = 0; n < count_; ++n) table_.insert(few_[n], n);
    in_table_ = true;
    return table_.insert(d.value, next);
  }

private:
  std::array<std::uint32_t, 16> few_; // darts, in the order of instances
  std::uint32_t count_ = 0;
  IndexMap table_;
  bool in_table_ = false;
};

class Matcher {
public:
  Matcher(const Rule& rule, const GMap& map, Match& match)
      : rule_(rule), plan_(rule.plan), map_(map), match_(match) {}

  Mismatch run(const Hooks& hooks) {
    match_.nodes = rule_.left.nodes.size();
    match_.positions = match_.nodes > 0 ? rule_.left[plan_.hooks[0]].label.size() : 0;
    match_.darts.clear();
    match_.neighbours.clear();
    match_.instances = 1;
    CHECK_NOTE(hooks.size() == plan_.hooks.size(),
               fmt::format("\"{}\" takes {} hooks", rule_.name(), plan_.hooks.size()));
    if (plan_.links_volumes && map_.dimension() == 2) return {.kind = Mismatch::Kind::SheetWithoutVolumes};
    for (Dart d : hooks.span())
      if (!map_.alive(d)) return {.kind = Mismatch::Kind::NoDart, .dart = d};
    if (match_.nodes == 0) return {};
    if (Mismatch mismatch = look_at_hooks(hooks)) return mismatch;
    walk_hooks(hooks);
    if (Mismatch mismatch = follow_steps()) return mismatch;
    for (const RulePlan::Test& test : plan_.tests)
      if (Mismatch mismatch = ask(test)) return mismatch;
    return rule_.settings.may_fold ? Mismatch{} : overlap();
  }

private:
  Dart& dart(std::size_t instance, int node) {
    return match_.darts[instance * match_.nodes + static_cast<std::size_t>(node)];
  }

  // What most mismatches fail at, before anything is walked.
  Mismatch look_at_hooks(const Hooks& hooks) const {
    for (std::size_t h = 0; h < plan_.hooks.size(); ++h)
      for (const RulePlan::Test& test : plan_.first_tests) {
        if (test.node != plan_.hooks[h]) continue;
        const bool free = map_.is_free(test.link, hooks[h]);
        if (test.kind == Kind::Loop && !free)
          return {Mismatch::Kind::NotFree,        test.node, test.link, hooks[h], hooks[h],
                  map_.alpha(test.link, hooks[h])};
        if (test.kind == Kind::Arc && free)
          return {Mismatch::Kind::Free, test.node, test.link, hooks[h], {}, {}};
      }
    return {};
  }

  // The instances: a walk over the orbit of the first hook, and the same walk from all other hooks.
  void walk_hooks(const Hooks& hooks) {
    thread_local Instances instance_of;
    instance_of.clear();
    match_.darts.resize(match_.nodes);
    for (std::size_t h = 0; h < plan_.hooks.size(); ++h) dart(0, plan_.hooks[h]) = hooks[h];
    const int first = plan_.hooks[0];
    const std::vector<int>& label = rule_.left[first].label;
    instance_of.insert(hooks[0], 0);
    for (std::size_t k = 0; k < match_.instances; ++k) {
      for (std::size_t p = 0; p < match_.positions; ++p) {
        const auto next = static_cast<std::uint32_t>(match_.instances);
        const Dart d = map_.alpha(label[p], dart(k, first));
        const std::uint32_t found = instance_of.insert(d, next);
        match_.neighbours.push_back(found);
        if (found != next) continue;
        ++match_.instances;
        match_.darts.resize(match_.darts.size() + match_.nodes);
        for (int hook : plan_.hooks) dart(next, hook) = map_.alpha(rule_.left[hook].label[p], dart(k, hook));
      }
    }
  }

  // An arc leads to another dart, even where the rule may fold.
  Mismatch follow_steps() {
    if (plan_.steps.empty()) return {};
    for (std::size_t k = 0; k < match_.instances; ++k)
      for (const RulePlan::Step& step : plan_.steps) {
        const Dart from = dart(k, step.from), to = map_.alpha(step.link, from);
        if (to == from)
          return {.kind = Mismatch::Kind::Free, .node = step.from, .link = step.link, .dart = from};
        dart(k, step.node) = to;
      }
    return {};
  }

  Mismatch ask(const RulePlan::Test& test) {
    for (std::size_t k = 0; k < match_.instances; ++k) {
      const Dart d = dart(k, test.node);
      const Dart wanted =
          test.kind == Kind::Implicit ? dart(match_.neighbour(k, test.to), test.node) : dart(k, test.to);
      const Dart is = map_.alpha(test.link, d);
      const bool free_arc = test.kind == Kind::Arc && is == d;
      if (is == wanted && !free_arc) continue;
      const Mismatch::Kind kind = free_arc                  ? Mismatch::Kind::Free
                                  : test.kind == Kind::Loop ? Mismatch::Kind::NotFree
                                  : test.kind == Kind::Implicit && rule_.left[test.node].hook
                                      ? Mismatch::Kind::NotIsomorphic
                                      : Mismatch::Kind::OtherDart;
      return {kind, test.node, test.link, d, wanted, is};
    }
    return {};
  }

  Mismatch overlap() const {
    const std::vector<Dart>& darts = match_.darts;
    if (match_.nodes == 1) return {}; // the walk visits each dart once
    if (darts.size() <= 16) {
      for (std::size_t n = 1; n < darts.size(); ++n)
        for (std::size_t m = 0; m < n; ++m)
          if (darts[n] == darts[m]) return {.kind = Mismatch::Kind::Twice, .dart = darts[n]};
      return {};
    }
    thread_local IndexSet met;
    met.clear();
    for (Dart d : darts)
      if (!met.insert(d.value)) return {.kind = Mismatch::Kind::Twice, .dart = d};
    return {};
  }

  const Rule& rule_;
  const RulePlan& plan_;
  const GMap& map_;
  Match& match_;
};

} // namespace

Mismatch find_match(const Rule& rule, const GMap& map, const Hooks& hooks, Match& match) {
  return Matcher(rule, map, match).run(hooks);
}

} // namespace rend
