// rend rule: the built-in rules and scripts, those of a preset, or of a file of rules: listed, shown, checked,
// drawn.
#include "render/clip/named_files.h"
#include "render/commands/command.h"
#include "render/console/console.h"
#include "render/console/json_text.h"
#include "render/console/signals.h"
#include "render/diagram/paint.h"
#include "render/diagram/rule_diagram.h"
#include "render/diagram/script_diagram.h"
#include "render/diagram/svg.h"
#include "render/facts/rule_facts.h"
#include "render/files/output.h"
#include "render/files/png.h"
#include "render/picture/scene_preset.h"
#include "sim/base/printable.h"
#include "sim/base/wording.h"
#include "sim/build/rule_book.h"
#include "sim/house_rules/house_scripts.h"
#include "sim/preset/paths.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>

namespace rend {
namespace {

struct RuleOptions {
  std::string name, file, out, on;
  bool json = false, allow_path = false;
};

// Of a preset, or of a file of rules.
RuleBook book_of(const RuleOptions& options, RuleFaults* faults = nullptr) {
  if (options.file.empty()) return {};
  const std::string text = read_preset_file(options.file); // once: it may be a pipe
  if (is_rules_text(text)) return read_rules_text(text, options.file, faults);
  const auto scene = load_scene_text(text, options.file);
  if (!options.allow_path) check_paths(*scene);
  return read_rules(*scene, faults);
}

RuleOrScript chosen_rule(const RuleOptions& options, const RuleBook& book, std::string& from) {
  std::vector<std::string> names;
  for (const RuleOrScript& each : book) {
    names.push_back(each.name());
    from = options.file;
    if (each.name() == options.name) return each;
  }
  from = "built-in";
  if (const auto found = find_house_rule_or_script(options.name)) return *found;
  for (const Rule& rule : house_rules()) names.push_back(rule.name());
  for (const Script& script : house_scripts()) names.push_back(script.name());
  throw UserError(Exit::Usage, {}, fmt::format("there is no rule {}", in_quotes(options.name)),
                  suggestion(options.name, names, "there are"));
}

Exit list(const RuleOptions& options) {
  std::vector<RuleFacts> all;
  for (const RuleOrScript& each : book_of(options)) all.push_back(rule_facts(each, options.file));
  for (const Rule& rule : house_rules()) all.push_back(rule_facts(rule, "built-in"));
  for (const Script& script : house_scripts()) all.push_back(rule_facts(script, "built-in"));
  if (!options.json) {
    print_result(list_in_words(all));
    return Exit::Done;
  }
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const RuleFacts& facts : all) json.push_back(json_of(facts));
  print_result(text_of(json, 2) + "\n");
  return Exit::Done;
}

Exit show_rule(const RuleOptions& options) {
  const RuleBook book = book_of(options);
  std::string from;
  const RuleFacts facts = rule_facts(chosen_rule(options, book, from), from);
  print_result(options.json ? text_of(json_of(facts), 2) + "\n" : facts_in_words(facts));
  return Exit::Done;
}

std::string counted(std::size_t count, const char* one) {
  return fmt::format("{} {}{}", count, one, count == 1 ? "" : "s");
}

// A script that applies a refused one is refused as well: of many, the first ones tell why. The last one is
// told by the caller.
void tell_all_but_the_last(const RuleFaults& faults) {
  constexpr std::size_t most = 20;
  const std::size_t told = std::min(most, faults.size() - 1);
  for (std::size_t n = 0; n < told; ++n) print_error(faults[n].what(), faults[n].hint);
  if (const std::size_t more = faults.size() - 1 - told)
    print_note(fmt::format("{} more {} refused; the last one:", more, more == 1 ? "is" : "are"));
}

void tell_warnings(const Rule& rule) {
  for (const RuleWarning& warning : rule.warnings) {
    const std::string place = warning.place.text();
    print_note((place.empty() ? "" : place + ": ") + warning.what +
               (warning.hint.empty() ? "" : "; " + warning.hint));
  }
}

Exit check(const RuleOptions& options) {
  std::size_t rules = house_rules().size(), scripts = house_scripts().size();
  if (!options.file.empty()) {
    RuleFaults faults;
    const RuleBook book = book_of(options, &faults);
    if (!faults.empty()) {
      tell_all_but_the_last(faults);
      throw faults.back();
    }
    for (const RuleOrScript& each : book)
      if (each.rule) tell_warnings(*each.rule);
    rules = static_cast<std::size_t>(
        std::count_if(book.begin(), book.end(), [](const RuleOrScript& each) { return each.rule != nullptr; }));
    scripts = book.size() - rules;
    if (book.empty()) {
      print_result(fmt::format("{} states no rule and no script\n", printable(options.file)));
      return Exit::Done;
    }
  }
  const std::string both = scripts == 0 ? counted(rules, "rule")
                           : rules == 0 ? counted(scripts, "script")
                                        : counted(rules, "rule") + " and " + counted(scripts, "script");
  print_result(fmt::format("{} {} well formed\n", both, rules + scripts == 1 ? "is" : "are"));
  return Exit::Done;
}

Drawing drawing_of(const Rule& rule, const RuleOptions& options) {
  const RuleShown shown = show(rule, options.on);
  if (!shown.sample) print_note("no small map was found to which the rule applies: only its graphs are drawn");
  return diagram_of(rule, shown);
}

Drawing drawing_of(const Script& script, const RuleOptions& options) {
  const ScriptShown shown = show(script, options.on);
  if (!shown.sample) print_note("no small map was found to which the script applies: only its steps are told");
  return diagram_of(script, shown);
}

Exit draw_rule(const RuleOptions& options) {
  const std::filesystem::path out = options.out;
  const bool png = out.extension() == ".png";
  if (!png && out.extension() != ".svg")
    throw UserError(Exit::Usage, {},
                    fmt::format("{}: its ending names no format that rend can write", in_quotes(options.out)),
                    "end the name in .svg or .png");
  if (png) require_png();
  const RuleBook book = book_of(options);
  std::string from;
  const RuleOrScript chosen = chosen_rule(options, book, from);
  const std::filesystem::path file = resolve_link(out);
  NamedFiles files;
  if (!options.file.empty()) files.reads("the rules", options.file);
  files.writes("the drawing", file);
  const Drawing drawing = chosen.rule ? drawing_of(*chosen.rule, options) : drawing_of(*chosen.script, options);
  const GracefulStop graceful_stop;
  if (png)
    write_png(file, paint(drawing, 2));
  else
    write_atomically(file, svg_text(drawing));
  sync_folder(file.parent_path());
  return Exit::Done;
}

using Chosen = std::shared_ptr<Exit (*)(const RuleOptions&)>;
using Options = std::shared_ptr<RuleOptions>;

CommandLine subcommand(const CommandLine& app, const char* name, const char* what, const Chosen& chosen,
                       Exit (*run)(const RuleOptions&)) {
  const CommandLine made = app.add_command(name, what);
  made.on_parsed([chosen, run] { *chosen = run; });
  return made;
}

void add_file(const CommandLine& app, const Options& options, const char* name) {
  app.add_option(name, options->file, "a preset, or a file of rules").type_name("FILE");
  app.add_flag("--allow-path", options->allow_path, "allow the preset to name files outside of its folder");
}

void add_rule(const CommandLine& app, const Options& options) {
  app.add_option("name", options->name, "a rule or script, as rend rule list names them")
      .required()
      .type_name("NAME");
  add_file(app, options, "--in");
}

std::function<Exit()> declare_rule(const CommandLine& app) {
  auto options = std::make_shared<RuleOptions>();
  auto chosen = std::make_shared<Exit (*)(const RuleOptions&)>(nullptr);
  app.require_command();
  app.footer("rend help rule tells how rules are written.");
  const auto json = [&](const CommandLine& to, const char* what) {
    to.add_flag("--json", options->json, what);
  };
  const CommandLine listing =
      subcommand(app, "list", "list the built-in rules and scripts, and those of a file", chosen, list);
  add_file(listing, options, "file");
  json(listing, "print the same as a JSON array on stdout");
  const CommandLine showing =
      subcommand(app, "show", "show the text of one rule or script, and what it does", chosen, show_rule);
  add_rule(showing, options);
  json(showing, "print the same as one JSON object on stdout");
  const CommandLine checking = subcommand(
      app, "check",
      "check that all rules and scripts of a file are well formed; without a file, the built-in ones", chosen,
      check);
  add_file(checking, options, "file");
  const CommandLine drawing = subcommand(
      app, "draw", "draw the two graphs of a rule, or the steps of a script, and a small map before and after",
      chosen, draw_rule);
  add_rule(drawing, options);
  drawing.add_option("-o,--output", options->out, "the picture").required().type_name("FILE.svg|FILE.png");
  std::vector<std::string> samples;
  for (const SampleMap& each : sample_maps()) samples.push_back(each.name);
  drawing.add_option("--on", options->on, "the map: " + listed(samples) + "; default: the first one that fits")
      .type_name("MAP");
  return [options, chosen] { return (*chosen)(*options); };
}

} // namespace

Command rule_command() {
  return {"rule", "list, show, check and draw rules and scripts: changes of the mesh, for <apply> and <tear>",
          declare_rule};
}

} // namespace rend
