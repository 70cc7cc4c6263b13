// rend info: what a preset builds, with its bytes, and what is left out.
#include "render/commands/command.h"
#include "render/console/console.h"
#include "render/console/json_text.h"
#include "render/facts/inventory.h"

#include <nlohmann/json.hpp>

#include <memory>

namespace rend {
namespace {

struct InfoOptions {
  SessionOptions session;
  bool json = false;
};

Exit info(InfoOptions options) {
  options.session.quiet = true; // notes are part of the result
  Session session(options.session);
  const Inventory inventory = inventory_of(session);
  print_result(options.json ? text_of(json_of(inventory), 2) + "\n" : inventory_in_words(inventory));
  return Exit::Done;
}

std::function<Exit()> declare_info(const CommandLine& app) {
  auto options = std::make_shared<InfoOptions>();
  add_preset_options(app, options->session);
  app.add_flag("--json", options->json, "print the same as one JSON object on stdout");
  return [options] { return info(*options); };
}

} // namespace

Command info_command() {
  return {"info", "show what a preset builds, and what it leaves out and why", declare_info};
}

} // namespace rend
