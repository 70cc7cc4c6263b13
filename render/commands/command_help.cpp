// rend help: commands, the preset's vocabulary and schema, where laws tear, the manual, and completions.
#include "render/commands/command.h"
#include "render/console/console.h"
#include "render/help/completion.h"
#include "render/help/help.h"
#include "render/help/manual.h"
#include "render/help/rule_page.h"
#include "render/help/schema.h"
#include "render/help/tear_table.h"
#include "render/help/usage.h"
#include "render/picture/scene_preset.h"
#include "render/report/machine.h"
#include "sim/base/wording.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace rend {
namespace {

struct HelpOptions {
  std::string topic;
  std::string element; // empty: all
};

const std::vector<std::string>& topics() {
  static const std::vector<std::string> all{"preset", "rule", "tear", "schema", "man", "completion"};
  return all;
}

void check_words(const HelpOptions& options) {
  std::vector<std::string> known = topics();
  for (const Command& command : all_commands())
    if (command.name != "rule") known.push_back(command.name); // a topic already
  if (!options.topic.empty() && std::find(known.begin(), known.end(), options.topic) == known.end())
    throw UserError(Exit::Usage, {}, fmt::format("there is no help on {}", in_quotes(options.topic)),
                    suggestion(options.topic, known, "there is on"));
  if (options.element.empty() || options.topic == "preset" || options.topic == "completion" ||
      (options.topic == "man" && options.element == "preset"))
    return;
  throw UserError(Exit::Usage, {}, fmt::format("help on {} takes no second word", in_quotes(options.topic)),
                  options.topic == "man"
                      ? "rend help man prints rend(1), rend help man preset rend-preset(5)"
                      : "rend help preset " + options.element + " tells about an element of a preset");
}

std::string man_page(const CLI::App& root, bool of_presets) {
  const Machine build = this_machine();
  return of_presets ? manual_of_presets(scene_type(), build.version, build.date)
                    : manual(usage_of(root), build.version, build.date);
}

std::string completion(const CLI::App& root, const std::string& name) {
  const Shell* shell = find_shell(name);
  if (shell == nullptr)
    throw UserError(Exit::Usage, {},
                    name.empty() ? "no shell is named" : "there is no completion for " + in_quotes(name),
                    suggestion(name, shell_names(), "there is for"));
  CompletionSource source{usage_of(root), settable_attributes(scene_type()), element_names(scene_type())};
  for (const std::string& one : shell_names()) source.elements.push_back(one);
  return shell->script(source);
}

std::string page(const CLI::App& root, const HelpOptions& options) {
  if (options.topic == "preset") {
    const auto element = options.element.empty() ? std::nullopt : std::optional(options.element);
    return help_preset(scene_type(), element, wants_colour(stdout));
  }
  if (options.topic == "rule") return rule_page();
  if (options.topic == "tear") return tear_table(wants_colour(stdout));
  if (options.topic == "schema") return schema(scene_type());
  if (options.topic == "man") return man_page(root, !options.element.empty());
  if (options.topic == "completion") return completion(root, options.element);
  // App::help would print the page of the subcommand that was parsed, that is, of `help`.
  if (options.topic.empty())
    return root.get_formatter()->make_help(&root, root.get_name(), CLI::AppFormatMode::Normal);
  return root.get_subcommand(options.topic)->help("rend");
}

Exit help(const CLI::App& root, const HelpOptions& options) {
  check_words(options);
  print_trusted_result(page(root, options));
  return Exit::Done;
}

std::function<Exit()> declare(CLI::App& app) {
  auto options = std::make_shared<HelpOptions>();
  app.add_option(
         "topic", options->topic,
         "preset: what a preset may hold; rule: how rules are written; tear: every criterion with every "
         "change; schema: the same as an XML schema; man: the manual, for man; "
         "completion: a script for a shell; or a command")
      ->type_name(choices(topics()) + "|COMMAND");
  app.add_option("element", options->element,
                 "an element of a preset, such as stretch or body.springs; of man: preset; of completion: " +
                     listed(shell_names()))
      ->type_name("ELEMENT");
  return [options, root = app.get_parent()] { return help(*root, *options); };
}

} // namespace

Command help_command() {
  return {"help", "tell what a command or a preset may hold", declare};
}

} // namespace rend
