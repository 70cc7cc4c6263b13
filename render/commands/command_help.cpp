// rend help: commands, the preset's vocabulary and schema, where laws tear, the manual, and completions.
#include "render/commands/command.h"
#include "render/compare/tolerances.h"
#include "render/console/console.h"
#include "render/console/terminal.h"
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
  static const std::vector<std::string> all{"preset", "rule", "tear",      "tolerances",
                                            "schema", "man",  "completion"};
  return all;
}

bool is_command(const std::string& word) {
  const std::vector<Command>& all = all_commands();
  return std::any_of(all.begin(), all.end(), [&](const Command& one) { return one.name == word; });
}

void check_words(const HelpOptions& options) {
  std::vector<std::string> known = topics();
  for (const Command& command : all_commands())
    if (command.name != "rule") known.push_back(command.name); // a topic already
  if (!options.topic.empty() && std::find(known.begin(), known.end(), options.topic) == known.end())
    throw UserError(Exit::Usage, {}, fmt::format("there is no help on {}", in_quotes(options.topic)),
                    suggestion(options.topic, known, "topics"));
  if (options.element.empty() || options.topic == "preset" || options.topic == "tolerances" ||
      options.topic == "completion" || (options.topic == "man" && options.element == "preset"))
    return;
  const std::vector<std::string> elements = element_names(scene_type());
  const bool is_element = std::find(elements.begin(), elements.end(), options.element) != elements.end();
  throw UserError(Exit::Usage, {}, fmt::format("help on {} takes no further word", in_quotes(options.topic)),
                  options.topic == "man"
                      ? "rend help man prints the manual of rend, rend help man preset that of presets"
                  : is_element ? "rend help preset " + options.element + " explains this element of a preset"
                               : "rend help " + options.topic + " prints the whole page");
}

std::string man_page(const CommandLine& root, bool of_presets) {
  const Machine build = this_machine();
  return of_presets ? manual_of_presets(scene_type(), build.version, build.date)
                    : manual(root.usage(), build.version, build.date);
}

std::string completion(const CommandLine& root, const std::string& name) {
  const Shell* shell = find_shell(name);
  if (shell == nullptr)
    throw UserError(Exit::Usage, {},
                    name.empty() ? "no shell is named" : "there is no completion for " + in_quotes(name),
                    suggestion(name, shell_names(), "shells"));
  CompletionSource source{root.usage(), settable_attributes(scene_type()), element_names(scene_type())};
  for (const std::string& one : shell_names()) source.elements.push_back(one);
  return shell->script(source);
}

std::string help_tolerances(const std::optional<std::string>& element, bool colour, std::size_t columns) {
  const std::string opening = "A file of tolerances tells rend diff which differences between pictures are "
                              "allowed: rend diff EXPECTED NOW "
                              "-t FILE.xml. It is an XML file with one <tolerances>. What a <case> gives "
                              "replaces what stands before it; any "
                              "lifts a limit. Without any limit, pictures must be equal. A single limit for "
                              "all pictures is given as --limit "
                              "NAME=VALUE. Example:\n"
                              "<tolerances>\n"
                              "<default max=\"1\" mean=\"0.1\"/>\n"
                              "<case name=\"tear/moebius*\" flip=\"0.002\" max=\"any\"/>\n"
                              "</tolerances>";
  return help_elements(tolerances_type(), opening, element, colour, columns);
}

std::string page(const CommandLine& root, const HelpOptions& options) {
  const std::size_t columns = text_columns(stdout, page_columns);
  if (options.topic == "preset") {
    const auto element = options.element.empty() ? std::nullopt : std::optional(options.element);
    return help_preset(scene_type(), element, wants_colour(stdout), columns);
  }
  if (options.topic == "tolerances") {
    const auto element = options.element.empty() ? std::nullopt : std::optional(options.element);
    return help_tolerances(element, wants_colour(stdout), columns);
  }
  if (options.topic == "rule") return fitted(rule_page(), columns);
  if (options.topic == "tear") return tear_table(wants_colour(stdout), columns);
  if (options.topic == "schema") return schema(scene_type());
  if (options.topic == "man") return man_page(root, !options.element.empty());
  if (options.topic == "completion") return completion(root, options.element);
  return (options.topic.empty() ? root : root.command(options.topic)).page();
}

// `rend help camera` is `rend help preset camera`.
HelpOptions with_topic(const HelpOptions& options) {
  const std::vector<std::string> elements = element_names(scene_type());
  const std::string& word = options.topic;
  const bool is_path = word.find('.') != std::string::npos;
  const bool is_element = is_path || std::find(elements.begin(), elements.end(), word) != elements.end();
  const std::vector<std::string>& known = topics();
  const bool is_topic = std::find(known.begin(), known.end(), word) != known.end() || is_command(word);
  if (!options.element.empty() || !is_element || is_topic) return options;
  return {"preset", word};
}

Exit help(const CommandLine& root, const HelpOptions& given) {
  const HelpOptions options = with_topic(given);
  check_words(options);
  print_trusted_result(page(root, options));
  return Exit::Done;
}

std::function<Exit()> declare_help(const CommandLine& app) {
  auto options = std::make_shared<HelpOptions>();
  app.add_option("topic", options->topic,
                 "one of\n"
                 "preset: the elements and attributes of a preset\n"
                 "rule: how rules are written\n"
                 "tear: every criterion of <tear> with every change\n"
                 "tolerances: which differences rend diff may allow\n"
                 "schema: presets as an XML schema\n"
                 "man: the manual, for man\n"
                 "completion: a script for a shell\n"
                 "or a command, such as render")
      .type_name(choices(topics()) + "|COMMAND");
  app.add_option(
         "element", options->element,
         "after preset or tolerances: one element, such as stretch or body.springs; after man: preset; after "
         "completion: " +
             listed(shell_names()))
      .type_name("ELEMENT");
  return [options, root = app.parent()] { return help(root, *options); };
}

} // namespace

Command help_command() {
  return {"help", "explain commands, presets, rules and tolerances", declare_help};
}

} // namespace rend
