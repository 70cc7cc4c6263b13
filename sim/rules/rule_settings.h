// A rule as it is written: in a preset, in a file of rules, or in a program.
//
//   <rule name="star" about="a triangle on each side of a face, around its middle"
//         left="a*(0,1) a|3"   right="a(0,_) b(_,2) c(1,2)  a-1-b b-0-c  a|3 b|3 c|3">
//     <set node="c" position="mean(a, face)"/>
//     <when test="size(a, face) > 3" otherwise="it is a triangle already"/>
//   </rule>
#pragma once

#include "sim/base/settings.h"

#include <string>
#include <vector>

namespace rend {

// The values of the vertex of a node: of a new vertex, which needs a position, or of one that is kept, which
// then moves. Rest position and velocity follow the position's expression where they have none of their own.
struct RuleSetSettings {
  std::string node = {};     // of the right graph
  std::string position = {}; // [m], an expression
  std::string rest = {};     // [m]
  std::string velocity = {}; // [m/s]
  SettingsSource source = {};
};
template <> const Fields<RuleSetSettings>& fields_of();

// A further condition of a match.
struct RuleWhenSettings {
  std::string test = {};                          // an expression
  enum class At { Hook, All, Any } at = At::Hook; // at the hook's dart, at all or at some instance
  std::string otherwise = {};                     // what is said where it does not hold
  SettingsSource source = {};
};
template <> const Fields<RuleWhenSettings>& fields_of();

// An argument of the rule: a name that its expressions use, and the value that it has unless another is given.
struct RuleWhereSettings {
  std::string name = {};
  std::string value = {}; // an expression of numbers
  SettingsSource source = {};
};
template <> const Fields<RuleWhereSettings>& fields_of();

// A name for an expression, which those after it and the rule's other expressions may use.
struct RuleLetSettings {
  std::string name = {};
  std::string value = {}; // an expression of the rule: a number, a point or a condition
  SettingsSource source = {};
};
template <> const Fields<RuleLetSettings>& fields_of();

struct RuleSettings {
  std::string name = {};
  std::string about = {};
  std::string left = {}, right = {}; // graphs: sim/rules/rule_graph.h
  bool may_fold = false;             // it also matches where darts of the left graph coincide
  std::vector<RuleSetSettings> sets = {};
  std::vector<RuleWhenSettings> whens = {};
  std::vector<RuleWhereSettings> wheres = {};
  std::vector<RuleLetSettings> lets = {};
  SettingsSource source = {};
};
template <> const Fields<RuleSettings>& fields_of();

} // namespace rend
