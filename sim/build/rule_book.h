// The rules that a scene's elements may name: those of the preset, those of files of rules, and the house's.
//
//   <scene name="..."> <rules file="my-rules.xml"/> <rule name="..." left="..." right="..."/> ... </scene>
//
// A file of rules holds <rules> with any number of <rule>. Names differ; a preset may not redefine a rule of
// the house.
#pragma once

#include "sim/base/parameters.h"
#include "sim/rules/rule.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace rend {

using RuleBook = std::vector<std::shared_ptr<const Rule>>;

const ElementType& rule_type();       // <rule>
const ElementType& rules_type();      // <rules file> of a scene
const ElementType& rules_file_type(); // the root of a file of rules

RuleSettings read_rule(const PresetNode& rule);

// UserError: what is wrong with a rule or a file, and two rules of one name.
RuleBook read_rules(const PresetNode& scene);
RuleBook read_rules_file(const std::filesystem::path& path);

// The same of a text; `file` is its name in messages. And whether a text is one, and no preset, by its root.
RuleBook read_rules_text(std::string_view text, const std::string& file);
bool is_rules_text(std::string_view text);

// In the book, then in the house. UserError, at the attribute of `source`, with the nearest name.
std::shared_ptr<const Rule> find_rule(const RuleBook& book, const std::string& name,
                                      const SettingsSource& source, std::string_view attribute);

} // namespace rend
