// What `rend rule list` and `rend rule show` tell about a rule or a script.
#pragma once

#include "sim/rules/script.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace rend {

struct RuleFacts {
  struct Hook {
    std::string node;
    std::string orbit, cell; // "<0,1>", "face, one side"
  };
  struct Argument {
    std::string name, value; // its default, as it is written
  };
  std::string name = {}, about = {};
  std::string from = {}; // "built-in", or the file
  std::vector<Hook> hooks = {};
  std::vector<Argument> arguments = {};
  std::vector<std::string> creates = {}, keeps = {}, removes = {}; // nodes
  bool fits_sheets = true;                                         // solids always
  bool folds = false;
  std::string asks_for = {};             // what only laws of tearing know, such as "stress"; empty: nothing
  std::string text = {};                 // the element <rule> or <script>
  bool script = false;                   // then it has no nodes but its hook, and
  std::vector<std::string> applies = {}; // what its steps apply, each once
};
RuleFacts rule_facts(const Rule& rule, const std::string& from);
RuleFacts rule_facts(const Script& script, const std::string& from);
RuleFacts rule_facts(const RuleOrScript& what, const std::string& from);

nlohmann::ordered_json json_of(const RuleFacts& facts);
std::string facts_in_words(const RuleFacts& facts);
std::string list_in_words(const std::vector<RuleFacts>& all); // a line each

} // namespace rend
