// rend help: commands, the preset's vocabulary, and its schema.
#include "render/app/command.h"
#include "render/app/console.h"
#include "render/app/help.h"
#include "render/app/preset_types.h"
#include "render/app/schema.h"
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

Exit help(const CLI::App& root, const HelpOptions& options) {
  if (!options.element.empty() && options.topic != "preset")
    throw UserError(Exit::Usage, {}, fmt::format("help on {} takes no second word", in_quotes(options.topic)),
                    "rend help preset " + options.element + " tells about an element of a preset");
  if (options.topic == "preset") {
    const auto element = options.element.empty() ? std::nullopt : std::optional(options.element);
    print_result(help_preset(scene_type(), element, wants_colour(stdout)));
  } else if (options.topic == "schema") {
    print_result(schema(scene_type()));
  } else if (options.topic.empty()) {
    // App::help would print the page of the command that was parsed, which is this one.
    print_result(root.get_formatter()->make_help(&root, root.get_name(), CLI::AppFormatMode::Normal));
  } else {
    std::vector<std::string> topics{"preset", "schema"};
    for (const Command& command : all_commands()) topics.push_back(command.name);
    if (std::find(topics.begin(), topics.end(), options.topic) == topics.end())
      throw UserError(Exit::Usage, {}, fmt::format("there is no help on {}", in_quotes(options.topic)),
                      suggestion(options.topic, topics, "there is on"));
    print_result(root.get_subcommand(options.topic)->help("rend"));
  }
  return Exit::Done;
}

std::function<Exit()> declare(CLI::App& app) {
  auto options = std::make_shared<HelpOptions>();
  app.add_option("topic", options->topic,
                 "preset: what a preset may hold; schema: the same as an XML schema; or a command")
      ->type_name("TOPIC");
  app.add_option("element", options->element, "an element of a preset, such as stretch or body.springs")
      ->type_name("ELEMENT");
  return [options, root = app.get_parent()] { return help(*root, *options); };
}

} // namespace

Command help_command() {
  return {"help", "tell what a command or a preset may hold", declare};
}

} // namespace rend
