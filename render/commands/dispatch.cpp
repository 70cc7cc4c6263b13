#include "render/commands/command.h"
#include "render/commands/version.h"
#include "render/console/console.h"
#include "render/console/fatal_errors.h"
#include "render/console/signals.h"
#include "sim/base/check.h"
#include "sim/base/simd_width.h"
#include "sim/base/wording.h"
#include "sim/mesh/mesh_name.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <memory>
#include <new>
#include <sstream>
#include <stdexcept>

namespace rend {

const std::vector<Command>& all_commands() {
  static const std::vector<Command> commands{render_command(), batch_command(), run_command(),   info_command(),
                                             mesh_command(),   rule_command(),  sheet_command(), diff_command(),
                                             study_command(),  check_command(), help_command()};
  return commands;
}

namespace {

std::unique_ptr<CLI::App> make_app(std::function<Exit()>& chosen) {
  auto app = std::make_unique<CLI::App>("rend: pictures of things that tear and break.", "rend");
  app->set_version_flag("--version", version_in_words, "print the version, its commit, and those of libraries");
  app->set_help_flag("-h,--help", "print this page");
  app->require_subcommand(1);
  app->footer("rend COMMAND --help tells a command's options; rend help preset, what a preset may hold.");
  app->get_formatter()->column_width(34);
  for (const Command& command : all_commands()) {
    CLI::App* sub = app->add_subcommand(command.name, command.what);
    sub->callback([&chosen, run = command.declare(*sub)] { chosen = run; });
  }
  return app;
}

// Reports a missing or unknown command in plainer words than CLI11.
void check_command(int count, const char* const* arguments) {
  std::vector<std::string> names;
  for (const Command& command : all_commands()) names.push_back(command.name);
  const std::string first = count > 1 ? arguments[1] : "";
  if (first.empty())
    throw UserError(Exit::Usage, {}, "no command is given",
                    "there are: " + listed(names) + "; rend --help says more");
  const std::string extension = std::filesystem::path(first).extension().string();
  if (first.front() != '-' && (extension == ".xml" || is_mesh_name(first)))
    throw UserError(
        Exit::Usage, {}, "no command is given, only " + in_quotes(first),
        extension == ".xml"
            ? fmt::format("rend render {0} makes pictures of it, rend run {0} its figures", in_quotes(first))
            : fmt::format("rend mesh info {} tells about it", in_quotes(first)));
  if (first.front() != '-' && std::find(names.begin(), names.end(), first) == names.end())
    throw UserError(Exit::Usage, {}, "there is no command " + in_quotes(first),
                    suggestion(first, names, "there are"));
}

Exit run_command_line(int count, const char* const* arguments) {
  simd_width(); // refuses a wrong REND_SIMD before anything is done
  check_command(count, arguments);
  std::function<Exit()> chosen;
  const std::unique_ptr<CLI::App> app = make_app(chosen);
  try {
    app->parse(count, arguments);
  } catch (const CLI::ParseError& error) {
    std::ostringstream out, err;
    if (app->exit(error, out, err) == 0) { // --help, --version
      print_result(out.str());
      return Exit::Done;
    }
    const auto subs = app->get_subcommands();
    const std::string which = subs.empty() ? "rend" : "rend " + subs.front()->get_name();
    throw UserError(Exit::Usage, {}, error.what(), which + " --help tells what there is");
  }
  return chosen();
}

} // namespace

int run_program(int count, const char* const* arguments) {
  keep_standard_streams();
  catch_signals();
  install_fatal_error_handlers();
  const auto end = [](Exit code) { return static_cast<int>(code); };
  try {
    return end(run_command_line(count, arguments));
  } catch (const UserError& error) {
    print_error(error.what(), error.hint);
    return end(error.code);
  } catch (const BrokenPipe&) {
    return 128 + SIGPIPE;           // as if SIGPIPE had ended it
  } catch (const std::bad_alloc&) { // of allocations without operator new
    end_without_memory();
  } catch (const std::length_error&) { // a size beyond the address space
    end_without_memory();
  } catch (const std::exception& error) { // including InternalError
    print_error(fmt::format("this is a fault of rend itself: {}", error.what()),
                "please report it, with the command line and the preset");
  } catch (...) {
    print_error("this is a fault of rend itself, of an unknown kind",
                "please report it, with the command line and the preset");
  }
  return end(Exit::Bug);
}

} // namespace rend
