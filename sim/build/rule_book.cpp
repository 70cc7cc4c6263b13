#include "sim/build/rule_book.h"

#include "sim/build/read_settings.h"
#include "sim/house_rules/house_scripts.h"
#include "sim/preset/paths.h"
#include "sim/preset/preset_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <optional>

namespace rend {
namespace {

template <class S> std::vector<S> read_all(const PresetNode& node, const char* name) {
  std::vector<S> all;
  for (const PresetNode* child : node.all(name)) all.push_back(read_settings<S>(*child));
  return all;
}

std::optional<RuleOrScript> find_in(const RuleBook& book, const std::string& name) {
  for (const RuleOrScript& each : book)
    if (each.name() == name) return each;
  return {};
}

// The word after the first '<' that begins an element: declarations and comments may stand before it.
std::string_view root_of(std::string_view text) {
  std::string_view rest = text;
  for (;;) {
    rest.remove_prefix(std::min(rest.find('<'), rest.size()));
    const std::string_view end = rest.starts_with("<!--") ? "-->" : rest.starts_with("<?") ? "?>" : "";
    if (end.empty()) break;
    rest.remove_prefix(std::min(rest.find(end), rest.size()));
  }
  if (!rest.empty()) rest.remove_prefix(1);
  return rest.substr(0, rest.find_first_of(" \t\r\n/>"));
}

const ElementType& type_of_root(std::string_view root) {
  return root == "rule" ? rule_type() : root == "script" ? script_type() : rules_file_type();
}

// Rules are made when they are met; scripts when all are known, each after those that it applies.
class Reader {
public:
  explicit Reader(RuleFaults* faults) : faults_(faults) {}

  void add_file(const std::filesystem::path& path) { add_text(read_preset_file(path), path.string()); }

  void add_text(std::string_view text, const std::string& file) {
    const ElementType& type = type_of_root(root_of(text));
    try {
      roots_.push_back(read_preset_text(text, file, type, {}));
    } catch (UserError& error) { // such as a second one after it
      if (&type != &rules_file_type() && error.hint.empty())
        error.hint = "a file of one rule holds nothing else; several stand in <rules> ... </rules>";
      throw;
    }
    const PresetNode& root = *roots_.back();
    if (root.name() != "rules") return add(root);
    for (const auto& child : root.children()) add(*child);
  }

  // What is neither a rule nor a script is passed by.
  void add(const PresetNode& node) {
    if (node.name() != "rule" && node.name() != "script") return;
    attempt(node.find("name") ? node.text("name") : std::string(), [&] {
      check_name(node);
      if (node.name() == "rule")
        made_.push_back({node.text("name"), nullptr, State::Done,
                         RuleOrScript(std::make_shared<const Rule>(read_rule(node)))});
      else
        made_.push_back({node.text("name"), &node, State::Waiting, {}});
    });
  }

  RuleBook run() {
    for (std::size_t n = 0; n < made_.size(); ++n) // not by iterators: refused ones are marked on the way
      if (made_[n].state == State::Waiting) attempt(made_[n].name, [&] { make(made_[n]); });
    RuleBook book;
    for (const Made& each : made_)
      if (each.what) book.push_back(*each.what);
    return book;
  }

private:
  enum class State { Waiting, Begun, Done };
  struct Made {
    std::string name;
    const PresetNode* script; // null: a rule
    State state;
    std::optional<RuleOrScript> what;
  };

  template <class F> void attempt(const std::string& name, F&& f) {
    try {
      f();
    } catch (const UserError& error) {
      if (!faults_) throw;
      faults_->push_back(error);
      refused_.push_back(name);
    }
  }

  void check_name(const PresetNode& node) const {
    const std::string& name = node.text("name");
    if (find_house_rule(name) || find_house_script(name))
      node.fail("name", fmt::format("{} is the name of a built-in rule", in_quotes(name)),
                "give it another name; rend rule show " + name + " shows that one");
    for (const Made& each : made_)
      if (each.name == name)
        node.fail("name", fmt::format("two rules are called {}", in_quotes(name)), "give each its own");
  }

  void make(Made& script) {
    script.state = State::Begun;
    path_.push_back(script.name);
    try {
      const auto find = [&](const ScriptStepSettings& step) { return found(script.name, step); };
      script.what = RuleOrScript(std::make_shared<const Script>(read_script(*script.script), find));
    } catch (const UserError&) {
      script.state = State::Done;
      path_.pop_back();
      throw;
    }
    script.state = State::Done;
    path_.pop_back();
  }

  RuleOrScript found(const std::string& script, const ScriptStepSettings& step) {
    for (Made& each : made_) {
      if (each.name != step.apply) continue;
      if (each.state == State::Begun) refuse_recursion(script, step);
      if (path_.size() > Script::deepest)
        step.source.fail("apply", fmt::format("script {}: scripts apply scripts more than {} deep",
                                              in_quotes(script), Script::deepest));
      if (each.state == State::Waiting) attempt(each.name, [&] { make(each); });
      if (each.what) return *each.what;
    }
    if (std::find(refused_.begin(), refused_.end(), step.apply) != refused_.end())
      step.source.fail("apply", fmt::format("script {}: it applies {}, which is refused", in_quotes(script),
                                            in_quotes(step.apply)));
    RuleBook known;
    for (const Made& each : made_)
      if (each.what) known.push_back(*each.what);
    return find_rule(known, step.apply, step.source, "apply");
  }

  [[noreturn]] void refuse_recursion(const std::string& script, const ScriptStepSettings& step) const {
    std::string way;
    for (auto at = std::find(path_.begin(), path_.end(), step.apply); at != path_.end(); ++at)
      way += in_quotes(*at) + " applies ";
    step.source.fail(
        "apply",
        fmt::format("script {}: it would go on for ever: {}{}", in_quotes(script), way, in_quotes(step.apply)),
        "a script is applied often by times of <apply>");
  }

  RuleFaults* faults_;
  std::vector<std::unique_ptr<PresetNode>> roots_; // scripts refer to them
  std::deque<Made> made_;                          // in the order in which they stand there
  std::vector<std::string> refused_, path_;
};

} // namespace

const ElementType& rule_type() {
  static const ElementType set = element_type_of<RuleSetSettings>("set", "where the vertex of a node is");
  static const ElementType when = element_type_of<RuleWhenSettings>("when", "a further condition of a match");
  static const ElementType where = element_type_of<RuleWhereSettings>("where", "an argument of the rule");
  static const ElementType let =
      element_type_of<RuleLetSettings>("let", "a name for an expression of the rule");
  static const ElementType type{
      "rule",
      "a change of the map, for <apply> and <tear>: what is matched, and what takes its place",
      attributes_of<RuleSettings>(),
      {{&set, 0, -1}, {&when, 0, -1}, {&where, 0, -1}, {&let, 0, -1}}};
  return type;
}

const ElementType& script_type() {
  static const ElementType step = [] {
    ElementType made = element_type_of<ScriptStepSettings>("for", "for each cell of the hook's orbit, a rule");
    made.further = "an argument of what is applied: an expression";
    return made;
  }();
  static const ElementType when = element_type_of<RuleWhenSettings>("when", "a further condition of its hook");
  static const ElementType where = element_type_of<RuleWhereSettings>("where", "an argument of the script");
  static const ElementType type{
      "script",
      "several rules as one change, for <apply> and <tear>: all of it is done, or nothing",
      attributes_of<ScriptSettings>(),
      {{&step, 1, -1}, {&when, 0, -1}, {&where, 0, -1}}};
  return type;
}

const ElementType& rules_type() {
  static const ElementType type{
      "rules",
      "a file of rules",
      {text("file",
            "<rules> with <rule> and <script> in it; relative to the preset, and in its folder or below")
           .is_required()},
      {}};
  return type;
}

const ElementType& rules_file_type() {
  static const ElementType type{
      "rules", "rules, for presets to name", {}, {{&rule_type(), 0, -1}, {&script_type(), 0, -1}}};
  return type;
}

RuleSettings read_rule(const PresetNode& node) {
  RuleSettings rule = read_settings<RuleSettings>(node);
  rule.sets = read_all<RuleSetSettings>(node, "set");
  rule.whens = read_all<RuleWhenSettings>(node, "when");
  rule.wheres = read_all<RuleWhereSettings>(node, "where");
  rule.lets = read_all<RuleLetSettings>(node, "let");
  return rule;
}

ScriptSettings read_script(const PresetNode& node) {
  ScriptSettings script = read_settings<ScriptSettings>(node);
  for (const PresetNode* child : node.all("for")) {
    ScriptStepSettings step = read_settings<ScriptStepSettings>(*child);
    for (const std::string& name : child->further()) step.arguments[name] = child->find(name)->text;
    script.steps.push_back(std::move(step));
  }
  script.whens = read_all<RuleWhenSettings>(node, "when");
  script.wheres = read_all<RuleWhereSettings>(node, "where");
  return script;
}

RuleBook read_rules(const PresetNode& scene, RuleFaults* faults) {
  Reader reader(faults);
  for (const auto& child : scene.children()) { // in the order in which they stand there
    if (child->name() == "rules") {
      const std::filesystem::path path = named_path(*child);
      std::error_code error;
      if (!std::filesystem::exists(path, error))
        throw UserError(Exit::NoInput, child->place("file"), path.string() + ": there is no such file of rules",
                        "its name is relative to the folder of the preset");
      if (!std::filesystem::is_regular_file(path, error)) // a pipe that nobody writes to would be waited for
        throw UserError(Exit::BadInput, child->place("file"), path.string() + ": is not a regular file",
                        "rules that a preset names stand in a file; pipes, devices and folders are not read");
      reader.add_file(path);
    }
    reader.add(*child);
  }
  return reader.run();
}

RuleBook read_rules_text(std::string_view text, const std::string& file, RuleFaults* faults) {
  Reader reader(faults);
  reader.add_text(text, file);
  return reader.run();
}

// What is no XML is left to the reader.
bool is_rules_text(std::string_view text) {
  const std::string_view root = root_of(text);
  return root == "rules" || root == "rule" || root == "script";
}

RuleOrScript find_rule(const RuleBook& book, const std::string& name, const SettingsSource& source,
                       std::string_view attribute) {
  if (const auto own = find_in(book, name)) return *own;
  if (const auto house = find_house_rule_or_script(name)) return *house;
  std::vector<std::string> names;
  for (const RuleOrScript& each : book) names.push_back(each.name());
  for (const Rule& rule : house_rules()) names.push_back(rule.name());
  for (const Script& script : house_scripts()) names.push_back(script.name());
  source.fail(attribute, fmt::format("there is no rule {}", in_quotes(name)),
              suggestion(name, names, "there are"));
}

} // namespace rend
