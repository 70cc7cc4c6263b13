// The rules and scripts that a scene's elements may name: those of the preset, those of files of rules, and the
// built-in ones.
//
//   <scene name="..."> <rules file="my-rules.xml"/> <rule name="..." left="..." right="..."/> ... </scene>
//
// A file of rules holds <rules> with any number of <rule> and <script>, or a single one of them. Names
// differ; a preset may not redefine a built-in rule. A script may apply what stands after it.
#pragma once

#include "sim/base/error.h"
#include "sim/base/parameters.h"
#include "sim/rules/script.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace rend {

using RuleBook = std::vector<RuleOrScript>;

const ElementType& rule_type();       // <rule>
const ElementType& script_type();     // <script>
const ElementType& rules_type();      // <rules file> of a scene
const ElementType& rules_file_type(); // the root of a file of rules

RuleSettings read_rule(const PresetNode& rule);
ScriptSettings read_script(const PresetNode& script);

// UserError: what is wrong with a rule, a script or a file, and two of one name. With `faults`: those of rules
// and scripts are put there instead, each once, and the others are returned.
using RuleFaults = std::vector<UserError>;
RuleBook read_rules(const PresetNode& scene, RuleFaults* faults = nullptr);

// The same of a text; `file` is its name in messages. And whether a text is one, and no preset, by its root.
RuleBook read_rules_text(std::string_view text, const std::string& file, RuleFaults* faults = nullptr);
bool is_rules_text(std::string_view text);

// In the book, then built-in. UserError, at the attribute of `source`, with the nearest name.
RuleOrScript find_rule(const RuleBook& book, const std::string& name, const SettingsSource& source,
                       std::string_view attribute);

} // namespace rend
