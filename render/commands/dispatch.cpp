#include "render/commands/command.h"
#include "render/commands/version.h"
#include "render/console/console.h"
#include "render/console/fatal_errors.h"
#include "render/console/signals.h"
#include "render/console/terminal.h"
#include "render/help/command_page.h"
#include "render/help/folding.h"
#include "sim/base/check.h"
#include "sim/base/simd_width.h"
#include "sim/base/stop_request.h"
#include "sim/base/wording.h"
#include "sim/mesh/mesh_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <memory>
#include <new>
#include <stdexcept>

namespace rend {

const std::vector<Command>& all_commands() {
  static const std::vector<Command> commands{
      render_command(), batch_command(), run_command(),  info_command(),  mesh_command(),  rule_command(),
      list_command(),   sheet_command(), diff_command(), study_command(), check_command(), help_command()};
  return commands;
}

namespace {

std::string page_of(const CommandUsage& usage, const std::string& name) {
  return command_page(usage, name, text_columns(stdout, page_columns));
}

void declare_commands(const CommandLine& root, std::function<Exit()>& chosen) {
  root.require_command();
  root.footer(
      "rend COMMAND --help lists the options of a command. rend help preset explains what a preset may hold, "
      "rend help tolerances what rend diff may allow. Results go to stdout, progress and notes to stderr.");
  for (const Command& command : all_commands()) {
    const CommandLine line = root.add_command(command.name, command.what);
    line.on_parsed([&chosen, run = command.declare(line)] { chosen = run; });
  }
}

// Reports a missing or unknown command in plainer words than CLI11.
void check_command(int count, const char* const* arguments) {
  std::vector<std::string> names;
  for (const Command& command : all_commands()) names.push_back(command.name);
  const std::string first = count > 1 ? arguments[1] : "";
  const std::string extension = std::filesystem::path(first).extension().string();
  if (first.front() != '-' && (extension == ".xml" || is_mesh_name(first)))
    throw UserError(Exit::Usage, {}, "a command is missing before " + in_quotes(first),
                    extension == ".xml"
                        ? fmt::format("rend render {0} makes pictures of it, rend run {0} prints its results",
                                      in_quotes(first))
                        : fmt::format("rend mesh info {} shows what is in it", in_quotes(first)));
  if (first.front() != '-' && std::find(names.begin(), names.end(), first) == names.end())
    throw UserError(Exit::Usage, {}, "there is no command " + in_quotes(first),
                    suggestion(first, names, "there are"));
}

// Options and words that the command does not take, as they were typed.
[[noreturn]] void refuse_extras(const Refusal& refusal, int count, const char* const* arguments) {
  const std::string& which = refusal.which;
  std::vector<std::string> left = refusal.words, options, words, known;
  for (int n = 1; n < count; ++n) {
    const auto found = std::find(left.begin(), left.end(), arguments[n]);
    if (found == left.end()) continue;
    (found->size() > 1 && found->front() == '-' ? options : words).push_back(*found);
    left.erase(found);
  }
  for (const OptionUsage& option : refusal.command.options)
    for (const std::string& name : option.names)
      if (name.starts_with("--")) known.push_back(name);
  const std::string all = which + " --help lists what it takes";
  if (options.empty())
    throw UserError(Exit::Usage, {},
                    fmt::format("{} does not take {}", which, in_quotes(words.empty() ? "" : words.front())),
                    all);
  std::string named, near;
  for (const std::string& option : options) {
    named += (named.empty() ? "" : ", ") + in_quotes(option);
    const std::string best = nearest(option.substr(0, option.find('=')), known);
    if (!best.empty()) near += (near.empty() ? "did you mean " : ", ") + in_quotes(best);
  }
  throw UserError(Exit::Usage, {},
                  fmt::format("{} has no option{} {}", which, options.size() == 1 ? "" : "s", named),
                  (near.empty() ? "" : near + "? ") + all);
}

// A command of commands (mesh, rule) without one of them, or with a word that names none.
[[noreturn]] void refuse_subcommand(const Refusal& refusal) {
  const std::string& which = refusal.which;
  std::vector<std::string> names;
  for (const CommandUsage& one : refusal.command.commands) names.push_back(one.name);
  for (const std::string& word : refusal.words)
    if (!word.starts_with('-'))
      throw UserError(Exit::Usage, {}, fmt::format("{} has no command {}", which, in_quotes(word)),
                      suggestion(word, names, "there are"));
  throw UserError(Exit::Usage, {}, fmt::format("{} needs a command: {}", which, listed(names)),
                  which + " --help tells what each does");
}

// As the command's usage calls it: PRESET rather than preset.
std::string name_of_argument(const std::string& name, const CommandUsage& command) {
  for (const OptionUsage& argument : command.positionals)
    if (argument.names.front() == name) return argument.value;
  return name;
}

// CLI11 puts the name of the type behind that of an option, and does not say what is wrong with it.
std::string in_plain_words(const Refusal& refusal) {
  const std::string& what = refusal.what;
  if (refusal.kind == Refusal::Kind::ArgumentMissing) {
    const std::size_t at = what.find(" is required");
    if (at != std::string::npos) return name_of_argument(what.substr(0, at), refusal.command) + " is missing";
  }
  if (refusal.kind == Refusal::Kind::ValueMissing && what.ends_with(" missing"))
    return what.substr(0, what.find(':')) + " needs a value";
  if (const std::size_t at = what.find(" not in {"); at != std::string::npos && what.ends_with('}')) {
    std::string choices;
    for (const char c : what.substr(at + 9, what.size() - at - 10))
      choices += c == ',' ? ", " : std::string(1, c);
    return what.substr(0, at) + " is not one of " + choices;
  }
  return what;
}

Exit run_command_line(int count, const char* const* arguments) {
  simd_width(); // refuses a wrong REND_SIMD before anything is done
  std::function<Exit()> chosen;
  const ProgramLine line("rend", "rend: simulates things that tear and break, and makes pictures of them.",
                         version_in_words, page_of);
  declare_commands(line.root(), chosen);
  if (count < 2) {
    print_progress(short_help(line.root().usage(), text_columns(stderr, page_columns)));
    return Exit::Usage;
  }
  check_command(count, arguments);
  try {
    if (const std::string text = line.parse(count, arguments); !text.empty()) { // --help, --version
      print_result(text);
      return Exit::Done;
    }
  } catch (const Refusal& refusal) {
    if (refusal.kind == Refusal::Kind::UnknownWords) refuse_extras(refusal, count, arguments);
    if (refusal.kind == Refusal::Kind::CommandMissing) refuse_subcommand(refusal);
    throw UserError(Exit::Usage, {}, in_plain_words(refusal), refusal.which + " --help lists what it takes");
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
  } catch (const StopRequested&) {
    print_error("stopped by a signal");
    return end(exit_code_of_signal());
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
