#include "sim/build/rule_book.h"

#include "sim/build/read_settings.h"
#include "sim/house_rules/house_rules.h"
#include "sim/preset/paths.h"
#include "sim/preset/preset_reader.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {
namespace {

template <class S> ElementType element(const std::string& name, const std::string& what) {
  return {name, what, attributes_of<S>(), {}};
}

template <class S> std::vector<S> read_all(const PresetNode& node, const char* name) {
  std::vector<S> all;
  for (const PresetNode* child : node.all(name)) all.push_back(read_settings<S>(*child));
  return all;
}

bool has(const RuleBook& book, const std::string& name) {
  return std::any_of(book.begin(), book.end(), [&](const auto& rule) { return rule->name() == name; });
}

void add(RuleBook& book, const PresetNode& node) {
  RuleSettings settings = read_rule(node);
  if (find_house_rule(settings.name))
    node.fail("name", fmt::format("{} is the name of a built-in rule", in_quotes(settings.name)),
              "give it another name; rend rule show " + settings.name + " shows that one");
  if (has(book, settings.name))
    node.fail("name", fmt::format("two rules are called {}", in_quotes(settings.name)), "give each its own");
  book.push_back(std::make_shared<const Rule>(std::move(settings)));
}

void add_text(RuleBook& book, std::string_view text, const std::string& file) {
  const auto root = read_preset_text(text, file, rules_file_type(), {});
  for (const PresetNode* rule : root->all("rule")) add(book, *rule);
}

void add_file(RuleBook& book, const std::filesystem::path& path) {
  add_text(book, read_preset_file(path), path.string());
}

} // namespace

const ElementType& rule_type() {
  static const ElementType set = element<RuleSetSettings>("set", "where the vertex of a node is");
  static const ElementType when = element<RuleWhenSettings>("when", "a further condition of a match");
  static const ElementType where = element<RuleWhereSettings>("where", "an argument of the rule");
  static const ElementType type{
      "rule",
      "a change of the map, for <apply> and <tear>: what is matched, and what takes its place",
      attributes_of<RuleSettings>(),
      {{&set, 0, -1}, {&when, 0, -1}, {&where, 0, -1}}};
  return type;
}

const ElementType& rules_type() {
  static const ElementType type{
      "rules",
      "a file of rules",
      {text("file", "<rules> with <rule> in it; relative to the preset, and in its folder or below")
           .is_required()},
      {}};
  return type;
}

const ElementType& rules_file_type() {
  static const ElementType type{"rules", "rules, for presets to name", {}, {{&rule_type(), 0, -1}}};
  return type;
}

RuleSettings read_rule(const PresetNode& node) {
  RuleSettings rule = read_settings<RuleSettings>(node);
  rule.sets = read_all<RuleSetSettings>(node, "set");
  rule.whens = read_all<RuleWhenSettings>(node, "when");
  rule.wheres = read_all<RuleWhereSettings>(node, "where");
  return rule;
}

RuleBook read_rules(const PresetNode& scene) {
  RuleBook book;
  for (const auto& child : scene.children()) { // in the order in which they stand there
    if (child->name() == "rules") {
      const std::filesystem::path path = named_path(*child);
      std::error_code error;
      if (!std::filesystem::exists(path, error))
        throw UserError(Exit::NoInput, child->place("file"), path.string() + ": there is no such file of rules",
                        "names are relative to the preset");
      add_file(book, path);
    }
    if (child->name() == "rule") add(book, *child);
  }
  return book;
}

RuleBook read_rules_file(const std::filesystem::path& path) {
  RuleBook book;
  add_file(book, path);
  return book;
}

RuleBook read_rules_text(std::string_view text, const std::string& file) {
  RuleBook book;
  add_text(book, text, file);
  return book;
}

// Skips what may stand before the root: declarations and comments. What is no XML is left to the reader.
bool is_rules_text(std::string_view text) {
  std::string_view rest = text;
  for (;;) {
    rest.remove_prefix(std::min(rest.find('<'), rest.size()));
    const std::string_view end = rest.starts_with("<!--") ? "-->" : rest.starts_with("<?") ? "?>" : "";
    if (end.empty()) break;
    rest.remove_prefix(std::min(rest.find(end), rest.size()));
  }
  const std::string_view root = rest.substr(0, rest.find_first_of(" \t\r\n/>"));
  return root == "<rules" || root == "<rule"; // the latter lacks the former, and its reader says so
}

std::shared_ptr<const Rule> find_rule(const RuleBook& book, const std::string& name,
                                      const SettingsSource& source, std::string_view attribute) {
  for (const auto& rule : book)
    if (rule->name() == name) return rule;
  if (const Rule* found = find_house_rule(name))
    return {std::shared_ptr<const Rule>(), found}; // lives for ever
  std::vector<std::string> names;
  for (const auto& rule : book) names.push_back(rule->name());
  for (const Rule& rule : house_rules()) names.push_back(rule.name());
  source.fail(attribute, fmt::format("there is no rule {}", in_quotes(name)),
              suggestion(name, names, "there are"));
}

} // namespace rend
