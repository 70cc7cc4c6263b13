// Completion for fish: one line for each option of each command.
#include "render/help/completion.h"

#include <fmt/format.h>

namespace rend {
namespace {

std::string quoted(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\'' || c == '\\') out += '\\';
    out += c;
  }
  return fmt::format("'{}'", out);
}

// The argument of -x -a, or its replacement.
std::string arguments(const Candidates& offer) {
  switch (offer.kind) {
  case Candidates::Kind::Nothing:
    return " -x";
  case Candidates::Kind::Words:
    return fmt::format(" -x -a {}", quoted(joined_by_blanks(offer.words)));
  case Candidates::Kind::List:
    return fmt::format(" -x -a \"(__fish_complete_list , '__rend_lines {}')\"", joined_by_blanks(offer.words));
  case Candidates::Kind::Files:
    if (offer.extension.empty()) return " -r -F";
    return fmt::format(" -k -x -a '(__fish_complete_suffix .{})'", offer.extension);
  case Candidates::Kind::Folders:
    return " -x -a '(__fish_complete_directories)'";
  case Candidates::Kind::Attributes:
    return " -x -a '(__rend_attributes)'";
  case Candidates::Kind::Elements:
    return " -x -a '(__rend_elements)'";
  }
  return "";
}

std::string option_line(const OptionUsage& option, const std::string& start, const CommandUsage& program) {
  std::string out = start;
  for (const std::string& name : option.names)
    out +=
        name.starts_with("--") ? fmt::format(" -l {}", name.substr(2)) : fmt::format(" -s {}", name.substr(1));
  if (!option.value.empty()) out += arguments(candidates_for(option, program));
  return fmt::format("{} -d {}\n", out, quoted(first_phrase(option.what)));
}

void add_completions(const CommandUsage& command, const std::string& path, const CommandUsage& program,
                     std::string& out) {
  const std::string start =
      fmt::format("complete -c rend -n '{}{}'", path.empty() ? "__rend_only" : "__rend_at", path);
  for (const CommandUsage& part : command.commands)
    out += fmt::format("complete -c rend -n '__rend_only{}' -a {} -d {}\n", path, part.name, quoted(part.what));
  for (const OptionUsage& option : command.options) out += option_line(option, start, program);
  for (const OptionUsage& positional : command.positionals)
    out += fmt::format("{}{}\n", start, arguments(candidates_for(positional, program)));
  for (const CommandUsage& part : command.commands)
    add_completions(part, fmt::format("{} {}", path, part.name), program, out);
}

constexpr const char* fish_functions = R"fish(
function __rend_at # COMMAND...: whether that is the command
  set -l words (commandline -opc)[2..-1]
  set -l number (count $argv)
  test (count $words) -ge $number; and test "$words[1..$number]" = "$argv"
end

function __rend_only # COMMAND...: whether nothing else stands there yet
  set -l words (commandline -opc)[2..-1]
  test "$words" = "$argv"
end

function __rend_lines
  printf '%s\n' $argv
end

complete -c rend -f
)fish";

std::string fish_script(const CompletionSource& source) {
  std::string out = "# Completion of rend for fish, as `rend help completion fish` prints it.\n";
  out += fish_functions;
  out += "\nfunction __rend_attributes\n  __rend_lines";
  for (const SettableAttribute& set : source.sets) {
    if (set.values.empty()) out += fmt::format(" {}=", set.path);
    for (const std::string& value : set.values) out += fmt::format(" {}={}", set.path, value);
  }
  out += fmt::format("\nend\n\nfunction __rend_elements\n  __rend_lines {}\nend\n\n",
                     joined_by_blanks(source.elements));
  add_completions(source.program, "", source.program, out);
  return out;
}

} // namespace

Shell fish_shell() {
  return {"fish", fish_script};
}

} // namespace rend
